-- A faster car on the left lane changes into ours, closer than polite, and slows down.
-- We brake, keep our distance again and drive on.
return scenario 'cut_in' {
    town = 'town1',
    duration = 25,
    seed = 7,
    cars = 20,
    weather = 'clear_noon',
    params = {
        gap = 12,         -- [m] from our front to its rear when it begins to change lanes
        speed_kmh = 45,   -- ours; it is 10 km/h faster, and 10 km/h slower once in front of us
        over = 2.5,       -- [s] that the lane change takes
    },

    run = function(p)
        -- Who and where: two lanes in one direction; we on the right, the other one ahead on the left.
        local right_lane = pick_lane{ length = 150, left = true, optional = true }
                        or pick_lane{ left = true }
        local ego = spawn{ name = 'ego', model = 'sedan', driver = 'autopilot',
                           lane = right_lane, s = 8, speed_kmh = p.speed_kmh }
        local other = spawn{ name = 'other', model = 'hatchback', driver = 'traffic',
                             lane = lane_left_of(right_lane), s = 8 + p.gap, speed_kmh = p.speed_kmh + 10 }

        local cut_in = false
        check.never('collision', function() return ego:collided() end)
        check.min('gap', function() if cut_in then return gap(ego, other) end end, 2)
        check.eventually('in front', function() return cut_in and other:lane() == ego:lane() end)

        -- It draws ahead ...
        ego:set_speed_kmh(p.speed_kmh)
        other:set_speed_kmh(p.speed_kmh + 10)
        wait_until(function() return gap(ego, other) >= p.gap end, { timeout = 10 })

        -- ... and cuts in.
        cut_in = true
        print(string.format('%.2f s: cuts in, %.1f m ahead of us', time(), gap(ego, other)))
        other:change_lane(right_lane, { over = p.over })
        other:set_speed_kmh(p.speed_kmh - 10, { over = p.over })

        wait(8)
        print(string.format('%.2f s: %.1f m behind it at %.0f km/h', time(), gap(ego, other), ego:speed_kmh()))
        finish 'cut-in survived'
    end,
}

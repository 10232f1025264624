-- A faster car overtakes on the left, then changes into our lane, closer than polite.
-- We brake, keep our distance again and drive on.
return scenario 'cut_in' {
    town = 'town1',
    duration = 25,
    seed = 7,
    cars = 20,
    weather = 'clear_noon',
    params = {
        gap = 12,         -- [m] between our front and its rear when it begins to change lanes
        speed_kmh = 45,   -- ours; it is 10 km/h faster until it is in front of us
        over = 2.5,       -- [s] that the lane change takes
    },

    run = function(p)
        -- Who and where: two lanes in one direction; we on the right, the other one a little behind.
        local right_lane = pick_lane{ length = 90, left = true, optional = true }
                        or pick_lane{ left = true }
        local left_lane = lane_left_of(right_lane)
        local ego = spawn{ name = 'ego', model = 'sedan', driver = 'autopilot',
                           lane = right_lane, s = 14, speed_kmh = p.speed_kmh }
        local other = spawn{ name = 'other', model = 'hatchback', driver = 'traffic',
                             lane = left_lane, s = 12, speed_kmh = p.speed_kmh + 10 }

        check.never('collision', function() return ego:collided() end)
        check.max('deceleration', function() return -ego:acceleration() end, 8)
        check.eventually('in front', function() return gap(ego, other) > 4 and other:lane() == ego:lane() end)

        -- It comes past us ...
        ego:set_speed_kmh(p.speed_kmh)
        other:set_speed_kmh(p.speed_kmh + 10)
        local function is_ahead()
            return gap(ego, other) >= p.gap and gap(ego, other) < 100
        end
        wait_until(is_ahead, { timeout = 10 })

        -- ... and cuts in, slower now than we are.
        print(string.format('%.1f s: cuts in, %.1f m ahead of us', time(), gap(ego, other)))
        other:change_lane(ego:lane(), { over = p.over })
        other:set_speed_kmh(p.speed_kmh - 10, { over = p.over })

        wait(8)
        print(string.format('%.1f s: %.1f m behind it at %.0f km/h', time(), gap(ego, other), ego:speed_kmh()))
        finish 'cut-in survived'
    end,
}

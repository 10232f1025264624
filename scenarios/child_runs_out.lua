-- A van is parked at the kerb. When we are close, a child runs out from behind it.
-- We see the child late, brake hard and stop - or not.
return scenario 'child_runs_out' {
    town = 'town1',
    duration = 20,
    seed = 7,
    cars = 0,
    weather = 'clear_noon',
    params = {
        distance = 24,    -- [m] between our front and the child when it starts to run
        speed_kmh = 36,   -- ours
        running = 2.5,    -- [m/s] the child's
    },

    run = function(p)
        -- Where: the rightmost lane of a street, best one with a sidewalk and no bend.
        local lane = pick_lane{ length = 80, right = false, sidewalk = true, straight = true, optional = true }
                  or pick_lane{ length = 80, right = false }
        local kerb = -lane_width(lane) / 2
        local van_at = 58

        -- Who: the van half on the sidewalk, the child hidden behind its front, and we.
        spawn{ name = 'van', model = 'van', driver = 'parked', lane = lane, s = van_at, offset = kerb - 0.6 }
        local child = spawn{ name = 'child', model = 'child', lane = lane, s = van_at + 5.2, offset = kerb - 1.2 }
        local ego = spawn{ name = 'ego', model = 'sedan', driver = 'autopilot',
                           lane = lane, s = 6, speed_kmh = p.speed_kmh }

        check.never('child hit', function() return ego:collided(child) end, { stop = true })
        check.never('van hit', function() return ego:collided('vehicle') end)
        check.eventually('braked', function() return ego:acceleration() < -2 end)

        -- What happens: we come closer, the child runs.
        ego:set_speed_kmh(p.speed_kmh)
        wait_until(function() return gap(ego, child) < p.distance end, { timeout = 12 })
        print(string.format('%.2f s: the child runs, %.1f m ahead of us', time(), gap(ego, child)))
        child:walk_to{ across = lane, speed = p.running }

        wait(6)
        print(string.format('%.2f s: at %.0f km/h, %.1f m from the child', time(), ego:speed_kmh(), distance(ego, child)))
        finish 'nobody was hurt'
    end,
}

-- We turn left on a green that gives us no right of way: none of the oncoming cars has to brake for us, and we get through.
return scenario 'unprotected_left' {
    town = 'junctions', duration = 60,
    params = { gap = 2.0, speed_kmh = 40 },  -- [s] between the oncoming cars
    run = function(p)
        local junction = pick_junction{ lit = true, arms = 4 }
        local from = junction.arms[1].incoming[#junction.arms[1].incoming]
        local oncoming, to = junction.arms[3].incoming[1], lane_next(from, 'left')
        local ego = spawn{ name = 'ego', model = 'sedan', lane = from, s = lane_length(from) - 50, speed_kmh = 30 }
        ego:route_to{ lane = to, s = 40 }
        set_signal({ from, oncoming }, 'green')
        for i = 1, 3 do
            local car = spawn{ model = 'hatchback', lane = oncoming, speed_kmh = p.speed_kmh, lane_changes = false,
                               s = lane_length(oncoming) - 30 - (i - 1) * p.gap * p.speed_kmh / 3.6 }
            car:set_route{ oncoming, lane_next(oncoming, 'straight') }
            check.max('braking of ' .. car:name() .. ' [m/s^2]', function() return car:distance_driven() < 110 and -car:acceleration() or nil end, 1.5)
        end
        check.never('collision', function() return ego:collided() end)
        check.never('over a red light', function() return ego:ran_red() end)
        check.eventually('we turned left', function() return ego:lane() == to end)
        wait_until(function() return ego:route_completion() == 1 end, { timeout = 50 })
    end }

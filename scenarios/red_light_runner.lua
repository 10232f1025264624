-- A car runs a red light and meets us in the middle of the crossing, from wherever both start.
return scenario 'red_light_runner' {
    town = 'junctions', duration = 30,
    params = { our_start = 60, its_start = 50 },  -- [m] before the stop lines
    run = function(p)
        local junction = pick_junction{ lit = true, arms = 4 }
        local from = junction.arms[1].incoming[1]
        local across = junction.arms[2].incoming[1]
        local ego = spawn{ name = 'ego', model = 'sedan', lane = from, s = lane_length(from) - p.our_start, speed_kmh = 30, lane_changes = false }
        local runner = spawn{ name = 'runner', model = 'suv', lane = across, s = lane_length(across) - p.its_start, speed_kmh = 30, lane_changes = false }
        ego:set_route{ from, lane_next(from, 'straight') }
        runner:set_route{ across, lane_next(across, 'straight') }
        set_signal(from, 'green') set_signal(across, 'red')
        check.eventually('it ran red', function() return runner:ran_red() end)
        local met, apart
        check.eventually('it was timed to meet us within 0.1 s', function() return met and apart < 0.1 end)
        check.at_end('a crash', function() return ego:collided(runner) and not ego:ran_red() end)
        ego:hold_speed_kmh(30)
        runner:ignore_lights()
        local x, y, _, h = lane_point(from, lane_length(from)) local x2, y2, _, h2 = lane_point(across, lane_length(across))
        h, h2 = math.rad(h), math.rad(h2)  -- where both lanes, drawn on straight, cross
        local s = ((x2 - x) * math.sin(h2) - (y2 - y) * math.cos(h2)) / math.sin(h2 - h)
        met, apart = arrive_together(runner, ego, { x = x + s * math.cos(h), y = y + s * math.sin(h) })
        wait(1)
    end }

-- What scripting_bench measures: six actors among 100 cars, watched by 20 tasks that look in every tick and by 30 checks.
-- With tasks = 0 and checks = 0 the same drive without a script that looks.
return scenario 'scripted' {
    town = 'town1', duration = 60, seed = 7, cars = 100,
    params = { tasks = 20, checks = 30 },

    run = function(p)
        local lane = pick_lane{ length = 80 }
        local ego = spawn{ name = 'ego', model = 'sedan', lane = lane, s = 10, speed_kmh = 30 }
        local lead = spawn{ name = 'lead', model = 'suv', lane = lane, s = 40, speed_kmh = 30 }
        local far = spawn{ name = 'far', model = 'sedan' }
        local bus = spawn{ name = 'bus', model = 'bus', driver = 'traffic' }
        local bike = spawn{ name = 'bike', model = 'bicycle', driver = 'traffic' }
        local child = spawn{ name = 'child', model = 'child', lane = lane, s = 60, offset = -4 }
        wait_ticks(2)

        -- What scenarios wait for. None of it ever comes, so that each looks in every tick.
        local conditions = {
            function() return ego:speed_kmh() > 300 end,
            function() return ego:distance_driven() > 1e6 end,
            function() return gap(ego, lead) > 1e6 end,
            function() return ttc(ego, lead) < 0 end,
            function() return distance(ego, child) < 0 end,
            function() return time() > 1e6 end,
            function() return ego:x() > 1e6 end,
            function() return ego:collided(child) and ego:speed() > 100 end,
            function() return ego:lane() == 'nowhere' end,
            function() return math.abs(ego:offset() or 0) > 100 end,
        }
        for i = 1, p.tasks do
            local condition = conditions[(i - 1) % #conditions + 1]
            start(function() wait_until(condition) end)
        end

        local checks = {
            { 'never', function() return ego:collided() end },
            { 'never', function() return ego:speed_kmh() > 300 end },
            { 'max', function() return ego:speed() end, 100 },
            { 'min', function() return gap(ego, lead) end, -1 },
            { 'min', function() return ttc(ego, lead) end, -1 },
            { 'max', function() return math.abs(ego:acceleration()) end, 1000 },
            { 'min', function() return distance(ego, child) end, -1 },
            { 'max', function() return math.abs(ego:offset() or 0) end, 100 },
            { 'never', function() return ego:ran_red() or lead:collided(ego) end },
            { 'min', function() return ego:gap_ahead() end, -1, { optional = true } },
        }
        for i = 1, p.checks do
            local kind, look, limit, options = table.unpack(checks[(i - 1) % #checks + 1])
            check[kind](kind .. ' ' .. i, look, limit, options)
        end
        wait(3600)
    end,
}

-- The rain begins, the grip goes, and the lane change still takes the time that it was given.
return scenario 'lane_change_in_rain' {
    town = 'straight', duration = 20,
    weather = { { at = 0, preset = 'clear_noon' }, { at = 1, over = 4, preset = 'hard_rain_sunset' } },
    params = { speed_kmh = 80, over = 5 },
    run = function(p)
        local ego = spawn{ name = 'ego', model = 'sedan', lane = 'east_0', s = 100, speed_kmh = p.speed_kmh, lane_changes = false }
        local halfway, done
        check.max('speed held [km/h]', function() return math.abs(ego:speed_kmh() - p.speed_kmh) end, 0.3)
        check.always('on the road', function() return not ego:left_road() end)
        check.eventually('half of it in half the time', function() return halfway and math.abs(math.abs(halfway) - 1.9) < 0.4 end)
        check.eventually('all of it in time', function() return done and math.abs(done) < 0.15 end)
        check.at_end('keeps the new lane', function() return ego:lane() == 'east_1' and math.abs(ego:offset()) < 0.1 end)
        ego:hold_speed_kmh(p.speed_kmh)
        wait(6)
        ego:change_lane('left', { over = p.over })
        wait(p.over / 2)
        halfway = ego:offset('east_1')
        wait(p.over / 2 + 0.1)
        done = ego:offset('east_1')
        wait(3)
    end }

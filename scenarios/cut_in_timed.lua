-- A car in the left lane cuts in at a gap of our choice, within a time of our choice (OpenSCENARIO: LaneChangeAction).
return scenario 'cut_in_timed' {
    town = 'straight', duration = 20,
    params = { gap = 20, speed_kmh = 50, over = 3 },  -- [m] from our front to its rear; [km/h] of both; [s]
    run = function(p)
        local ego = spawn{ name = 'ego', model = 'sedan', lane = 'east_0', s = 100, speed_kmh = p.speed_kmh, lane_changes = false }
        local other = spawn{ name = 'other', model = 'hatchback', ahead_of = ego, gap = p.gap, lane = 'left', speed_kmh = p.speed_kmh }
        local before, began, halfway, done = true
        check.max('speed held before [km/h]', function() return before and math.abs(ego:speed_kmh() - p.speed_kmh) or nil end, 0.3)
        check.max('its speed held [km/h]', function() return math.abs(other:speed_kmh() - p.speed_kmh) end, 0.5)
        check.eventually('cut in at the gap', function() return began and math.abs(began - p.gap) < 0.2 end)
        check.eventually('half of it in half the time', function() return halfway and math.abs(math.abs(halfway) - 1.9) < 0.4 end)
        check.eventually('all of it in time', function() return done and math.abs(done) < 0.15 end)
        check.always('we keep our lane', function() return ego:lane() == 'east_0' end)
        check.never('collision', function() return ego:collided() end)
        ego:hold_speed_kmh(p.speed_kmh)
        other:hold_speed_kmh(p.speed_kmh)
        wait(2)
        began = gap(ego, other)
        other:change_lane('right', { over = p.over })
        before = false ego:hold_speed(false)
        wait(p.over / 2) halfway = other:offset('east_0')
        wait(p.over / 2 + 0.1) done = other:offset('east_0')
        wait(5)
    end }

-- The end of a jam: two hundred cars stand in three lanes, we come at 100 km/h and have to stop behind them, with nobody hit.
return scenario 'jam' {
    town = 'straight', duration = 40,
    params = { cars = 200, speed_kmh = 100 },
    run = function(p)
        local tail
        for i = 0, p.cars - 1 do
            local car = spawn{ model = i % 7 == 3 and 'van' or 'hatchback', driver = 'traffic', lane = 'east_' .. i % 3, s = 1200 - i // 3 * 8 }
            car:set_speed(0)
            if i % 3 == 0 then tail = car end
        end
        local ego = spawn{ name = 'ego', model = 'sedan', lane = 'east_0', s = 200, speed_kmh = p.speed_kmh, lane_changes = false }
        check.never('collision', function() return ego:collided() end)
        check.max('brakes no harder than [m/s^2]', function() return -ego:acceleration() end, 6)
        check.at_end('stands at the end of the jam', function() return ego:speed() < 0.1 and gap(ego, tail) < 8 end)
        check.at_end('all are there', function() return #ego:around(700, { kind = 'vehicle' }) == p.cars end)
        wait_until(function() return ego:speed() < 0.05 end, { timeout = 38 })
        wait(0.5)
    end }

-- Two egos behind a lead that slows down and speeds up: nobody closes up, and the second brakes no harder than the first.
return scenario 'platoon' {
    town = 'straight', duration = 90,
    params = { speed_kmh = 80, slow_kmh = 50 },
    run = function(p)
        local lead = spawn{ name = 'lead', model = 'lorry', lane = 'east_0', s = 300, speed_kmh = p.speed_kmh, lane_changes = false }
        local first = spawn{ name = 'first', model = 'sedan', behind = lead, gap = 40, speed_kmh = p.speed_kmh, lane_changes = false }
        local second = spawn{ name = 'second', model = 'suv', behind = first, gap = 40, speed_kmh = p.speed_kmh, lane_changes = false }
        local asked
        check.max('the lead does as told [km/h]', function() return asked and math.abs(lead:speed_kmh() - asked) or nil end, 0.5)
        for _, pair in ipairs{ { lead, first }, { first, second } } do
            check.min('gap behind ' .. pair[1]:name() .. ' [m]', function() return gap(pair[2], pair[1]) end, 10)
        end
        check.max('braking grows [m/s^2]', function() return first:acceleration() - second:acceleration() end, 3)
        check.never('collision', function() return first:collided() or second:collided() end)
        for _, speed in ipairs{ p.speed_kmh, p.slow_kmh, p.speed_kmh } do
            asked = nil
            lead:hold_speed_kmh(speed, { over = 14 })
            wait(15)
            asked = speed
            wait(8)
        end
    end }

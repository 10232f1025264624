-- Past a cyclist at 1.5 m, the least that the law asks for in many countries, and back.
return scenario 'overtake_cyclist' {
    town = 'straight', duration = 40,
    params = { clearance = 1.5, speed_kmh = 50 },
    run = function(p)
        local ego = spawn{ name = 'ego', model = 'sedan', lane = 'east_0', s = 100, speed_kmh = p.speed_kmh, lane_changes = false }
        local bike = spawn{ name = 'bike', model = 'bicycle', lane = 'east_0', s = 200, offset = -1.2, speed_kmh = 18, lane_changes = false }
        local beside
        check.max('speed held [km/h]', function() return math.abs(ego:speed_kmh() - p.speed_kmh) end, 0.3)
        check.max('its speed held [km/h]', function() return math.abs(bike:speed_kmh() - 18) end, 0.3)
        check.min('clearance [m]', function()
            if math.abs(bike:x() - ego:x() - 1.4) < 4 then beside = true return ego:lateral_gap(bike) end
        end, p.clearance)
        check.eventually('we passed', function() return beside and ego:x() > bike:x() + 10 end)
        check.never('collision', function() return ego:collided() end)
        check.at_end('back in the middle', function() return math.abs(ego:offset('east_0')) < 0.1 end)
        ego:hold_speed_kmh(p.speed_kmh)
        bike:hold_speed_kmh(18)
        bike:set_offset(-1.2)
        wait_until(function() return gap(ego, bike) < 45 end)
        ego:set_offset(p.clearance - 1.2 + 1.3 + 0.1, { over = 3 })  -- half their widths are 1.3 m together
        wait_until(function() return ego:x() > bike:x() + 12 end)
        ego:set_offset(0, { over = 3 })
        wait(6)
    end }

-- Euro NCAP CCRs: the ego approaches a standing car at a steady speed, and must stop behind it.
return scenario 'ccrs' {
    town = 'straight', duration = 40,
    params = { speed_kmh = 50, reacts_at = 80 },
    run = function(p)
        local ego = spawn{ name = 'ego', model = 'sedan', lane = 'east_0', s = 100, speed_kmh = p.speed_kmh, lane_changes = false }
        local target = spawn{ name = 'target', model = 'hatchback', driver = 'parked', lane = 'east_0', s = 400 }
        local approaching = true
        check.max('speed held [km/h]', function() return approaching and math.abs(ego:speed_kmh() - p.speed_kmh) or nil end, 0.3)
        check.always('lane kept', function() return ego:lane() == 'east_0' and math.abs(ego:offset()) < 0.2 end)
        check.never('collision', function() return ego:collided() end)
        check.at_end('stands behind the target', function() return ego:speed() < 0.1 and gap(ego, target) < 8 end)
        ego:hold_speed_kmh(p.speed_kmh)
        wait_until(function() return gap(ego, target) < p.reacts_at end)
        approaching = false
        ego:hold_speed(false)
        wait_until(function() return ego:speed() < 0.05 end, { timeout = 20 })
        wait(1)
    end }

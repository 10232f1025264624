-- Euro NCAP CCRb: both at 50 km/h, 40 m apart; the lead brakes with 6 m/s^2, and the ego, which held its speed until then, must not hit it.
return scenario 'ccrb' {
    town = 'straight', duration = 30,
    params = { gap = 40, deceleration = 6 },
    run = function(p)
        local ego = spawn{ name = 'ego', model = 'sedan', lane = 'east_0', s = 100, speed_kmh = 50, lane_changes = false }
        local lead = spawn{ name = 'lead', model = 'hatchback', ahead_of = ego, gap = p.gap, speed_kmh = 50 }
        local before, braking = true, false
        check.max('speed held before [km/h]', function() return before and math.abs(ego:speed_kmh() - 50) or nil end, 0.3)
        check.min('the lead brakes [m/s^2]', function() return braking and -lead:acceleration() or nil end, 0.95 * p.deceleration)
        check.never('collision', function() return ego:collided() end)
        ego:hold_speed_kmh(50)
        lead:hold_speed_kmh(50)
        wait(3)
        lead:brake(p.deceleration)
        before = false
        ego:hold_speed(false)
        wait(0.5)
        braking = true
        wait_until(function() return lead:speed() < 3 end)
        braking = false
        wait_until(function() return ego:speed() < 0.05 end, { timeout = 15 })
    end }

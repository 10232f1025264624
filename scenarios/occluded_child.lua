-- A child walks out between parked vans, timed to meet a car that does not see it before; the car then has to stop.
return scenario 'occluded_child' {
    town = 'town1', duration = 20,
    params = { speed_kmh = 30, ttc = 2.0 },  -- [km/h] ours; [s] to the child's path when we may react
    run = function(p)
        local lane = pick_lane{ length = 90, sidewalk = true, straight = true, optional = true } or pick_lane{ length = 90, sidewalk = true }
        local ego = spawn{ name = 'ego', model = 'sedan', lane = lane, s = 5, speed_kmh = p.speed_kmh, lane_changes = false }
        for i = 1, 2 do spawn{ model = 'van', driver = 'parked', lane = lane, s = 75 - 8 * i, offset = -lane_width(lane) / 2 - 1.1 } end
        local x, y = lane_point(lane, 76, 0)
        local child = spawn{ name = 'child', model = 'child', lane = lane, s = 76, offset = -4.2 }
        local function ego_time() return (76 - ego:s() - 3.7) / ego:speed() end
        local walk, apart = 4.2 / 1.4, nil
        check.max('speed held [km/h]', function() return not apart and math.abs(ego:speed_kmh() - p.speed_kmh) or nil end, 0.3)
        check.eventually('they would have met within 0.1 s', function() return apart and apart < 0.1 end)
        check.never('child hit', function() return ego:collided 'walker' end)
        check.at_end('we let it pass', function() return ego:distance_driven() > 30 end)
        ego:hold_speed_kmh(p.speed_kmh)
        wait_until(function() return ego_time() <= walk end)
        local start = time()
        child:walk{ to = { x + (x - child:x()), y + (y - child:y()) }, speed = 1.4 }
        wait_until(function() return ego_time() <= p.ttc end)
        apart = math.abs(ego_time() - (walk - (time() - start)))
        ego:hold_speed(false)
        wait(6)
    end }

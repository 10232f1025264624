-- One of everything that a tick records, in 66 ticks: the ego drives into a van that stands.
return scenario 'crash' {
    town = 'small.net.xml', cars = 1, seed = 11, duration = 3.3,
    params = { throttle = 0.8 },
    run = function(p)
        local ego = spawn{ name = 'ego', model = 'sedan', driver = 'manual', lane = 'am_1', s = 20 }
        local van = spawn{ name = 'van', model = 'van', driver = 'parked', lane = 'am_1', s = 32 }
        local child = spawn{ name = 'child', model = 'child', lane = 'bm_1', s = 20, offset = -2 }
        local other = spawn{ name = 'other', model = 'hatchback', driver = 'traffic', lane = 'cm_1', s = 10, speed = 5 }
        check.never('hit the child', function() return ego:collided(child) end)
        check.never('hit the van', function() return ego:collided(van) end)
        ego:control{ throttle = p.throttle, steer = 0.02 }
        child:walk_to{ x = 120, y = 3, speed = 1.5 }
        wait(2)
        set_weather 'hard_rain_sunset'
        print 'rain'
        wait(1)
        for _, actor in ipairs{ ego, van, child, other } do
            print(tick(), actor:id(), actor:x(), actor:y(), actor:speed())
        end
        wait(5)
    end,
}

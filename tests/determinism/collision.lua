-- Ten dense seconds for the slow machines of the matrix: 50 cars, 20 walkers, seven vehicles with mass of which
-- two crash and one hits a walker. Everything that computes is busy: SUMO, Bullet, tyres, autopilots, walkers, Lua.
return scenario 'collision' {
    town = 'town1',
    duration = 10,
    seed = 11,
    cars = 50,
    weather = 'hard_rain_sunset',

    run = function()
        -- The crash: full throttle into a car that stands 25 m ahead.
        local street = pick_lane{ length = 60, straight = true }
        local hammer = spawn{ name = 'hammer', model = 'suv', driver = 'manual', lane = street, s = 8, speed = 14 }
        local anvil = spawn{ name = 'anvil', model = 'hatchback', driver = 'manual', lane = street, s = 33 }
        hammer:control{ throttle = 1 }
        anvil:control{ brake = 0.3, steer = 0.4 }

        -- The walker who is hit: 20 m ahead of a van that does not look.
        local other
        repeat other = pick_lane{ length = 80 } until other ~= street
        local van = spawn{ name = 'van', model = 'van', driver = 'manual', lane = other, s = 8, speed = 10 }
        local careless = spawn{ name = 'careless', model = 'adult', lane = other, s = 30 }
        van:control{ throttle = 0.4 }

        -- Who else drives: autopilots among the cars.
        for _, model in ipairs{ 'sedan', 'lorry', 'bus', 'hatchback' } do
            spawn{ model = model, driver = 'autopilot' }
        end

        -- Nineteen more people, on their way over the road or along it.
        local models = { 'adult', 'child', 'senior' }
        for i = 1, 19 do
            local lane = pick_lane{ length = 30 }
            local walker = spawn{ model = models[i % 3 + 1], lane = lane, s = random() * 25,
                                  offset = -lane_width(lane) }
            if i % 2 == 0 then
                walker:walk_to{ across = lane, speed = 1 + random() }
            else
                walker:walk_to{ lane = lane, s = lane_length(lane), offset = 0.5 - lane_width(lane) }
            end
        end

        check.eventually('the crash', function() return hammer:collided(anvil) end)
        check.eventually('the hit walker', function() return van:collided(careless) end)
        wait(60)
    end,
}

-- Three crashes among 60 cars, twenty seconds (in the matrix also longer, among more): a car into the back of one of
-- traffic's, a lorry into a parked one, a car into a cyclist, who falls. Each of the three hit becomes a body in mid-tick.
return scenario 'crashes' {
    town = 'town1',
    duration = 20,
    seed = 5,
    cars = 60,

    run = function()
        local function crash(name, rammer, target, driver, speed)
            local lane = pick_lane{ length = 60, straight = true }
            local hammer = spawn{ name = name, model = rammer, driver = 'manual', lane = lane, s = 8, speed = speed + 9 }
            local anvil = spawn{ name = name .. '_hit', model = target, driver = driver, lane = lane, s = 28,
                                 speed = driver == 'traffic' and speed or nil }
            hammer:control{ throttle = 0.2 }
            check.eventually(name, function() return hammer:collided(anvil) end)
            return hammer, anvil
        end
        local rear, lead = crash('rear_end', 'sedan', 'hatchback', 'traffic', 6)
        lead:hold_speed(6)
        wait(3)
        local lorry = crash('parked', 'lorry', 'wagon', 'parked', 4)
        wait(3)
        local third, cyclist = crash('fall', 'suv', 'bicycle', 'traffic', 4)
        cyclist:hold_speed(4)
        wait(3)
        for _, each in ipairs{ rear, lorry, third } do each:control{ brake = 1 } end
        wait(3600)
    end,
}

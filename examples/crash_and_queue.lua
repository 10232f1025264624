-- A car runs into the back of another one; both stay where they come to rest, near a junction, and traffic behind them queues.
-- examples/crash_film.sh makes a film of it from above, and one from behind.
return scenario 'crash_and_queue' {
    town = 'town1',
    duration = 60,
    seed = 4,
    cars = 80,
    walkers = 40,
    weather = 'clear_noon',

    run = function()
        local lane = pick_lane{ length = 90, straight = true }
        local hit = spawn{ name = 'hit', model = 'hatchback', driver = 'traffic', lane = lane, s = 66, speed_kmh = 15 }
        local rammer = spawn{ name = 'rammer', model = 'suv', driver = 'manual', lane = lane, s = 44, speed_kmh = 60 }
        -- Who comes behind them.
        for i, model in ipairs{ 'taxi', 'van', 'sedan' } do
            spawn{ name = 'behind_' .. i, model = model, driver = 'traffic', lane = lane, s = 40 - 11 * i, speed_kmh = 20 }
        end
        hit:hold_speed_kmh(15)
        rammer:control{ throttle = 0.3 }
        check.eventually('crash', function() return rammer:collided(hit) end)
        wait_until(function() return rammer:collided(hit) end)
        rammer:control{ brake = 1 }
        wait(3600)
    end,
}

-- A car without a destination wanders through a town full of traffic.
-- It keeps its distance, stops at red, touches nobody and gets on.
return scenario 'free_drive' {
    town = 'town1',
    duration = 60,
    seed = 7,
    cars = 100,
    weather = 'clear_noon',
    params = { report_every = 10 },  -- [s]

    run = function(p)
        local ego = spawn{ name = 'ego', model = 'sedan', driver = 'autopilot', may_overtake = true }

        check.never('collision', function() return ego:collided() end)
        check.never('blocked')

        while true do
            wait(p.report_every)
            print(string.format('%3.0f s: %5.1f km/h, %6.1f m driven, on %s',
                                time(), ego:speed_kmh(), ego:distance_driven(), ego:lane() or 'no lane'))
        end
    end,
}

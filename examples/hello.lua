-- Five seconds of a sedan finding its own way among ten cars.
return scenario 'hello' {
    town = 'town1',
    duration = 5,
    cars = 10,
    run = function()
        spawn{ name = 'ego', model = 'sedan', driver = 'autopilot' }
        wait(5)
    end,
}

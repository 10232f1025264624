-- What blind_driver_bench drives in: nobody else, and a car that only the bench's controls move.
return scenario 'empty_town' {
    town = 'town1', duration = 60, seed = 7, cars = 0,

    run = function()
        spawn{ name = 'ego', model = 'sedan', driver = 'manual' }
        wait(36000)
    end,
}

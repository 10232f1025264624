-- A car that another program drives, among the header's cars.
return scenario 'driven' {
    town = 'town1',
    duration = 3600,
    seed = 7,
    cars = 100,

    run = function()
        spawn{ name = 'ego', model = 'sedan', driver = 'external' }
        wait(36000)
    end,
}

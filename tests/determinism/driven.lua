-- Ten seconds of a car that another program drives: its controls are inputs, and in the trace.
return scenario 'driven' {
    town = 'town1',
    duration = 10,
    seed = 12,
    cars = 50,

    run = function()
        spawn{ name = 'ego', model = 'sedan', driver = 'external', latency = 2 }
        spawn{ model = 'bus', driver = 'autopilot' }
        wait(3600)
    end,
}

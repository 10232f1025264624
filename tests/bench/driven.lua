-- A car that another program drives, among the header's cars.
local cameras = {
    rgb84 = { { name = 'front', width = 84, height = 84 } },
    rgb200x88 = { { name = 'front', width = 200, height = 88 } },
    three800x600 = {
        { name = 'front', width = 800, height = 600 },
        { name = 'range', kind = 'depth', width = 800, height = 600 },
        { name = 'labels', kind = 'semantic', width = 800, height = 600 },
    },
}

return scenario 'driven' {
    town = 'town1',
    duration = 3600,
    seed = 7,
    cars = 100,
    params = { driver = 'external', cameras = 'none' },

    run = function(p)
        if p.driver == 'autopilot' then
            spawn{ name = 'ego', model = 'sedan' }
        else
            spawn{ name = 'ego', model = 'sedan', driver = 'external', rig = cameras[p.cameras] }
        end
        wait(36000)
    end,
}

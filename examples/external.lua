-- Another program drives: reprise run examples/external.lua --driver ego='python3 examples/follow_lane.py'
return scenario 'external' {
    town = 'town1',
    duration = 60,
    seed = 7,
    cars = 30,

    run = function()
        local ego = spawn{ name = 'ego', model = 'sedan', driver = 'external' }
        check.never('collision', function() return ego:collided() end)
        check.at_end('drove 200 m', function() return ego:distance_driven() > 200 end)
        wait(3600)
    end,
}

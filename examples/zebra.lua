-- A child waits at a pedestrian crossing and walks when a car comes near. The car sees it and stops in time.
return scenario 'zebra' {
    town = 'town1',
    duration = 40,
    seed = 5,

    run = function()
        local zebra = pick_crossing{ lit = false }
        local lane = zebra.incoming[1]
        local ego = spawn{ name = 'ego', model = 'sedan', lane = lane, s = math.max(0, lane_length(lane) - 60) }
        local child = spawn{ name = 'child', model = 'child', lane = zebra.name }

        check.never('collision', function() return ego:collided() end)
        check.never('off the road', function() return ego:left_road() end)
        check.min('gap to whatever is ahead', function() return ego:gap_ahead() end, 0.5)
        check.eventually('saw the child', function() return select(2, ego:gap_ahead()) == 'child' end)

        wait_until(function() return distance(ego, child) < 30 end)
        for _, each in ipairs(ego:around(40, { kind = 'walker' })) do
            print(string.format('%s is %.1f m ahead, %.1f m to the left', each.name, each.ahead, each.left))
        end
        child:walk{ to = zebra.to }
        wait_until(function() return distance(ego, child) > 35 end, { timeout = 30 })
    end,
}

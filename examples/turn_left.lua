-- Through a lit junction to the left: it may not run red, and arrives before a minute is over. Two tasks race for the end.
return scenario 'turn_left' {
    town = 'town1',
    duration = 90,
    seed = 3,
    cars = 20,

    run = function()
        local from, to
        repeat
            local arm = pick_junction{ lit = true }.arms[1]
            from = arm.incoming[#arm.incoming]
            to = from and lane_next(from, 'left')
        until to
        local ego = spawn{ name = 'ego', model = 'sedan', lane = from, s = math.max(0, lane_length(from) - 80) }
        ego:route_to{ lane = to, s = 30 }

        check.never('ran red', function() return ego:ran_red() end)
        check.never('wrong side', function() return select(2, ego:on_opposite_lane()) > 0.2 end)

        local watch = start(function()
            while true do
                wait(5)
                print(string.format('%3.0f %% of the way, %s', 100 * ego:route_completion(), ego:lane()))
            end
        end)
        local winner, word = race{
            function() wait_until(function() return ego:route_completion() == 1 end) return 'arrived' end,
            function() wait(60) return 'too late' end,
        }
        watch:cancel()
        print(winner, word)
        check.at_end('arrived', function() return winner == 1 end)
        wait_ticks(1)
    end,
}

-- Another program drives from a place to another in an empty town, as scenarios/drive_route.lua does with the
-- built-in driver: it reads in the tick where route_to sends it.
-- reprise run examples/pure_pursuit.lua --driver ego='python3 examples/pure_pursuit.py'
return scenario 'pure_pursuit' {
    town = 'town1',
    duration = 1200,
    seed = 7,
    cars = 0,
    params = { start = 'b3_c1_1', s = 46.4, goal = 'c2_c3_1', goal_s = 11.5 },   -- lanes, and [m] on them

    run = function(p)
        local ego = spawn{ name = 'ego', model = 'sedan', driver = 'external', lane = p.start, s = p.s }
        local length = ego:route_to{ lane = p.goal, s = p.goal_s }
        -- The goal may lie on the lane that we start from, behind us.
        local function arrived()
            return (p.start ~= p.goal or ego:distance_driven() > length - 20)
                and ego:lane() == p.goal and ego:s() >= p.goal_s - 3
        end
        check.never('collision', function() return ego:collided() end)
        check.eventually('arrived in time', arrived, { within = length / (10 / 3.6) + 10 })
        wait_until(arrived, { timeout = length / (10 / 3.6) + 11 })
        finish(arrived() and 'arrived' or 'late')
    end,
}

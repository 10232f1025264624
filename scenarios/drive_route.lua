-- One car drives the shortest way from a place to another in an empty town, as the tasks of
-- towns/town1/tasks.json ask for: it arrives in the time that 10 km/h would need, and touches nothing.
return scenario 'drive_route' {
    town = 'town1',
    duration = 1200,
    seed = 7,
    cars = 0,
    weather = 'clear_noon',
    params = {
        start = 'b1_b2_1', s = 10,        -- [m] on that lane
        goal = 'm2e_c3_1', goal_s = 40,   -- [m] on that one
    },

    run = function(p)
        local ego = spawn{ name = 'ego', model = 'sedan', driver = 'autopilot', lane = p.start, s = p.s }
        local length = ego:route_to{ lane = p.goal, s = p.goal_s }
        print(string.format('%.0f m to go', length))

        -- The goal may lie on the lane that we start from, behind us.
        local function arrived()
            return ego:distance_driven() > length - 10 and ego:lane() == p.goal and ego:s() >= p.goal_s
        end
        check.never('collision', function() return ego:collided() end)
        check.eventually('arrived in time', arrived, { within = length / (10 / 3.6) + 10 })

        wait_until(arrived)
        print(string.format('%.0f s: arrived after %.0f m', time(), ego:distance_driven()))
        finish 'arrived'
    end,
}

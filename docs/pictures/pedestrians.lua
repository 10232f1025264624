-- Every pedestrian of the catalogue, as pedestrians.jpg shows them:
--     reprise run docs/pictures/pedestrians.lua --town docs/pictures/plaza.net.xml -o p.mcap
--     reprise render p.mcap -o p --ticks 40 --actor 1 --mount=-29,0,3.2 --yaw 180 --pitch -11 \
--         --size 1800x620 --fov 58
return scenario 'pedestrians' {
    town = 'plaza', duration = 3, seed = 14,

    run = function()
        spawn{ name = 'camera', model = 'sedan', driver = 'parked', lane = 'ab_4', s = 100 }
        -- The shortest in front.
        local names = {
            'toddler', 'girl', 'boy', 'child', 'schoolgirl', 'schoolboy', 'teen_girl',
            'grandmother', 'dancer', 'pensioner', 'nun', 'woman_in_scarf', 'clerk',
            'senior', 'student_girl', 'shopper', 'nurse', 'jogger', 'businesswoman', 'mother',
            'artist', 'traveller', 'policewoman', 'teenager', 'grandfather', 'gardener',
            'tourist', 'skater', 'chef', 'hiker', 'commuter', 'postman', 'courier',
            'doctor', 'mechanic', 'student', 'road_worker', 'gentleman', 'adult',
            'office_worker', 'waiter', 'runner', 'musician', 'backpacker', 'builder', 'father',
            'police_officer', 'manager', 'firefighter', 'athlete',
        }
        local crowd = {}
        for i, model in ipairs(names) do
            local row = (i - 1) // 13
            local column = (i - 1) % 13 - 6
            crowd[i] = spawn{ model = model, driver = 'walker', lane = 'ab_4', s = 60 - 2.2 * row,
                              offset = 0.95 * column + 0.45 * (row % 2) }
        end
        -- Every third walks on.
        wait(1)
        for i, walker in ipairs(crowd) do
            if i % 3 == 0 then
                walker:walk_to{ lane = 'ab_4', s = 150, offset = 0.95 * ((i - 1) % 13 - 6) }
            end
        end
        wait(60)
    end,
}

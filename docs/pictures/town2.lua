-- Eight spots of Town 2, each seen from a parked car, among traffic and walkers: make.sh makes the pictures.
-- The cars are the first eight actors, in the order of make.sh.
local cameras = {
    { lane = 'd1_a1_0', s = 14 },                 -- crossing with lights
    { lane = 'd1_a1_0', s = 1 },                  -- square
    { lane = 'a1_t1_0', s = 33, offset = -11 },   -- park
    { lane = 'd1_l2_0', s = 6 },                  -- quiet street
    { lane = 'a1_d1_0', s = 5 },                  -- street by the square
    { lane = 'r1_t1_0', s = 8 },                  -- avenue
    { lane = 'r2_a2_0', s = 22 },                 -- bend
    { lane = 'l1_a1_0', s = 3 },                  -- shops
}

-- Along which lane, from where to where on it [m], who, and how far left of its middle [m].
local strolls = {
    { 'l1_a1_0', 30, 48, 'office_worker' }, { 'a1_l1_0', 2, 40, 'courier' }, { 'l1_a1_0', 46, 28, 'woman_in_scarf' },
    { 'a1_a2_0', 14, 40, 'musician' }, { 'a1_a2_0', 36, 12, 'shopper' }, { 'd1_a1_0', 5, 30, 'tourist' },
    { 'a1_t1_0', 38, 20, 'mother', -26 }, { 'a1_t1_0', 24, 38, 'schoolboy', -22 }, { 'a1_t1_0', 20, 50, 'jogger', -16 },
    { 'd1_a1_0', 8, 30, 'dancer', -14 }, { 'd1_a1_0', 30, 6, 'shopper', -24 }, { 'd1_a1_0', 4, 30, 'father', -34 },
    { 'd1_l2_0', 12, 45, 'student_girl' }, { 'l2_d1_0', 40, 10, 'senior' }, { 'd1_l2_0', 34, 10, 'nurse' },
    { 'a1_d1_0', 10, 34, 'businesswoman' }, { 'a1_d1_0', 30, 8, 'traveller' }, { 'd1_a1_0', 20, 34, 'artist' },
    { 'r1_t1_0', 28, 70, 'runner' }, { 'r1_t1_0', 36, 20, 'gentleman' }, { 'r1_t1_0', 60, 24, 'backpacker' },
    { 'r2_a2_0', 28, 46, 'grandfather' }, { 'r2_a2_0', 46, 26, 'commuter' }, { 'a2_r2_0', 60, 80, 'teen_girl' },
    { 'l1_a1_0', 8, 46, 'waiter' }, { 'a1_l1_0', 44, 10, 'clerk' }, { 'a1_l1_0', 20, 46, 'doctor' },
}

return scenario 'town2_spots' {
    town = 'town2', duration = 61, seed = 5, cars = 46,
    run = function()
        for i, place in ipairs(cameras) do
            spawn{ name = 'camera_' .. i, model = 'city_car', driver = 'parked', lane = place.lane, s = place.s,
                   offset = place.offset }
        end
        wait(20)
        for _, stroll in ipairs(strolls) do
            local lane, from, to, model, offset = table.unpack(stroll)
            local walker = spawn{ model = model, driver = 'walker', lane = lane, s = from, offset = offset }
            walker:walk_to{ lane = lane, s = to, offset = offset }
        end
        wait(60)
    end,
}

-- Everything in Lua that could answer differently from process to process, in one scenario: it prints the answers,
-- and its digest holds Lua's instructions and memory. Run it twice in any two environments and compare.
return scenario 'traps' {
    duration = 8,
    seed = 7,
    run = function()
        local function walk(t)
            local keys = {}
            for key, value in pairs(t) do keys[#keys + 1] = tostring(key) .. '=' .. tostring(value) end
            return table.concat(keys, ' ')
        end

        -- Order of keys: texts, long texts, numbers, mixed; three histories of one content.
        local short, long, mixed = {}, {}, { [true] = 1, [false] = 2, a = 3, [1] = 4, [2.5] = 5, [-1] = 6 }
        for i, key in ipairs{ 'ego', 'npc1', 'npc2', 'ped', 'truck', 'bike', 'cone', 'signal' } do
            short[key] = i
            long[key:rep(20)] = i
        end
        print(walk(short))
        print(walk(long))
        print(walk(mixed))
        local back, more = {}, {}
        for _, key in ipairs{ 'signal', 'cone', 'bike', 'truck', 'ped', 'npc2', 'npc1', 'ego' } do
            back[key] = short[key]
        end
        for i = 1, 100 do more['k' .. i] = i end
        for key, value in pairs(short) do more[key] = value end
        for i = 1, 100 do more['k' .. i] = nil end
        print(walk(back) == walk(short), walk(more) == walk(short))
        print(pcall(pairs, { [{}] = 1 }))
        print(pcall(pairs, { [print] = 1 }))

        -- Ties and contradictions in a sort.
        local list = {}
        for i = 1, 4000 do list[i] = { rank = i * i % 17, place = i } end
        table.sort(list, function(a, b) return a.rank < b.rank end)
        local hash = 0
        for _, entry in ipairs(list) do hash = (hash * 31 + entry.place) % 1000000007 end
        print(hash)
        table.sort(list, function(a, b) return a.rank <= b.rank end)
        hash = 0
        for _, entry in ipairs(list) do hash = (hash * 31 + entry.place) % 1000000007 end
        print(hash)
        local words = { 'b', 'B', 'a', '\xe4', 'Z', 'z', '_', 'a\0b', 'a\0a' }
        table.sort(words)
        print(table.concat(words, ' '))

        -- Texts of values.
        print({}, print, tostring(walk), string.format('%s', {}))
        print(select(2, pcall(error, {})), select(2, pcall(function() return {} .. 'x' end)))
        print(0.1 + 0.2, 1 / 3, 1e15, 2^53, 0 / 0, -(0 / 0), -1 / 0, -0.0, 1e100, 5 // 0.0)
        print(('x'):upper(), ('\xe4'):upper() == '\xe4', ('\xe4'):find('%a'), tonumber('1,5'), ('a'):byte() < ('B'):byte())

        -- Numbers: the mathematical library and chance.
        local sum = 0.0
        for i = 1, 2000 do
            local x = i * 0.37
            sum = sum + math.sin(x) * math.exp(x / 1000) + math.cos(x) ^ 2 + math.log(x) + x ^ 0.3 + math.atan(x, i)
        end
        print(sum)
        print(random(), random(), random('other'), random_int(1, 1000000, 'third'))

        -- Memory: tables keyed by objects and by texts that come and go, so that the hash decides when they grow.
        local keyed, live, first = {}, {}, 1
        local function churn(make, count)
            for i = 1, count do
                local wanted = 480 + i % 61
                while #live - first + 1 > wanted do
                    keyed[live[first]] = nil
                    live[first] = false
                    first = first + 1
                end
                while #live - first + 1 < wanted do
                    local key = make(i)
                    keyed[key] = i
                    live[#live + 1] = key
                end
                keyed[live[first]] = nil
                live[first] = false
                first = first + 1
                local key = make(-i)
                keyed[key] = i
                live[#live + 1] = key
            end
        end
        local kinds = {
            function() return {} end,
            function(i) return 'k' .. i .. 'x' .. #live end,
            function(i) return function() return i end end,
            function(i) return i * 0.37 + #live end,
        }
        for tick = 1, 120 do
            churn(kinds[tick % #kinds + 1], 100)
            wait_ticks(1)
        end
        local functions = {}
        for _, f in ipairs{ print, pairs, next, type, select, math.sin, string.byte, wait, spawn, ipairs({}) } do
            functions[f] = true
            functions[type] = nil
        end
        print(time(), tick())
    end,
}

-- Fills the memory while tables keyed by objects grow and shrink: the tick in which it is full must not depend on
-- addresses, and no pcall may notice.
return scenario 'out_of_memory' {
    run = function()
        local keyed, live, first, keep = {}, {}, 1, {}
        for i = 1, 480 do
            local key = {}
            keyed[key] = i
            live[#live + 1] = key
        end
        local caught = 0
        for i = 1, 10000000 do
            pcall(function()
                local wanted = 480 + i % 61
                while #live - first + 1 > wanted do
                    keyed[live[first]] = nil
                    live[first] = false
                    first = first + 1
                end
                while #live - first + 1 < wanted do
                    local key = {}
                    keyed[key] = i
                    live[#live + 1] = key
                end
                keep[#keep + 1] = { i, ('x'):rep(1500) .. i }
            end)
            if i % 2000 == 0 then wait_ticks(1) end
        end
    end,
}

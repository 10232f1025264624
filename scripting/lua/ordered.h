#pragma once

struct lua_State;

namespace reprise::scripting {

/// Lua's own `pairs` and `next` follow a hash that is seeded anew at every start, and its `sort` is
/// unstable and may choose pivots by the clock. These answer the same in every run.

/// Walks a snapshot of the keys: numbers, then strings (by bytes), then booleans. Refuses keys
/// without an order.
int ordered_pairs(lua_State* L);

/// The entry behind a key in that order. O(n).
int ordered_next(lua_State* L);

/// Stable merge sort; never raises "invalid order function". O(n log n).
int stable_sort(lua_State* L);

}  // namespace reprise::scripting

// Private to the room: one table of a trace as SQLite sees it, a "virtual table":
// https://www.sqlite.org/vtab.html
#pragma once

#include <sqlite3.h>

#include "replay/table/table.h"
#include "replay/trace_reader.h"

namespace reprise::exchange {

/// What a table reads; lives as long as the connection.
struct TickTable {
    replay::TraceReader* trace = nullptr;
    replay::Table table;
};

/// The functions that SQLite calls for such a table. The module's client data is a TickTable.
const sqlite3_module* tick_table_module();

}  // namespace reprise::exchange

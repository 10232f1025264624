// What it must do: show a list of the ticks as rows, without copying the trace.
// What it assumes: one thread; the reader is ours while a statement runs.
// How it goes: a cursor holds the rows of one tick, because a reader's view lives until its next
//   call and a statement may have several cursors. SQLite hands conditions on `tick` to best_index;
//   filter turns them into a range. They only save reading: SQLite checks every row again.
// What it keeps: SQLite's rule that no exception crosses it.
#include "exchange/tick_table.h"

#include <algorithm>
#include <cmath>
#include <exception>
#include <limits>
#include <memory>
#include <string>
#include <variant>
#include <vector>

#include "replay/table/kept.h"

namespace reprise::exchange {

namespace {

struct VirtualTable : sqlite3_vtab {
    const TickTable* source = nullptr;
};

struct Cursor : sqlite3_vtab_cursor {
    std::uint64_t tick = 0;  ///< whose rows are here
    std::uint64_t last = 0;  ///< to read
    std::vector<std::vector<replay::Value>> rows;
    std::size_t row = 0;
    sqlite3_int64 number = 0;  ///< of rows given so far

    const TickTable& source() const { return *static_cast<const VirtualTable*>(pVtab)->source; }

    void load() {
        rows.clear();
        row = 0;
        source().table.read(source().trace->recorded(tick),
                            [&](std::span<const replay::Value> values) {
                                rows.emplace_back(values.begin(), values.end());
                            });
    }

    /// Goes on to the first tick that has rows.
    void skip_empty() {
        while (rows.empty() && tick < last) {
            ++tick;
            load();
        }
    }

    void start(std::uint64_t first, std::uint64_t last_tick) {
        tick = first - 1;
        last = last_tick;
        rows.clear();
        row = 0;
        number = 0;
        skip_empty();
    }

    void next() {
        ++number;
        if (++row < rows.size())
            return;
        rows.clear();
        skip_empty();
    }

    bool at_end() const { return row >= rows.size(); }
};

Cursor& of(sqlite3_vtab_cursor* cursor) {
    return *static_cast<Cursor*>(cursor);
}

/// Turns exceptions into SQLite's errors.
template <typename Action>
int guarded(sqlite3_vtab* table, Action action) {
    try {
        action();
        return SQLITE_OK;
    } catch (const std::exception& error) {
        sqlite3_free(table->zErrMsg);
        table->zErrMsg = sqlite3_mprintf("%s", error.what());
        return SQLITE_ERROR;
    }
}

std::string declaration(const replay::Table& table) {
    std::string text = "CREATE TABLE t(";
    for (const std::string& column : table.columns())
        text += (&column == &table.columns().front() ? "\"" : ",\"") + column + "\"";
    return text + ")";
}

int connect(
    sqlite3* database, void* source, int, const char* const*, sqlite3_vtab** table, char**) {
    const auto* ours = static_cast<const TickTable*>(source);
    const int code = sqlite3_declare_vtab(database, declaration(ours->table).c_str());
    if (code != SQLITE_OK)
        return code;
    auto made = std::make_unique<VirtualTable>();
    made->source = ours;
    *table = made.release();
    return SQLITE_OK;
}

int disconnect(sqlite3_vtab* table) {
    delete static_cast<VirtualTable*>(table);
    return SQLITE_OK;
}

int open(sqlite3_vtab*, sqlite3_vtab_cursor** cursor) {
    *cursor = std::make_unique<Cursor>().release();
    return SQLITE_OK;
}

int close(sqlite3_vtab_cursor* cursor) {
    delete static_cast<Cursor*>(cursor);
    return SQLITE_OK;
}

/// Asks for the values of the conditions on `tick`; their operators go to filter as a text.
int best_index(sqlite3_vtab* table, sqlite3_index_info* info) {
    constexpr double rows_a_tick = 20;
    double ticks = static_cast<double>(static_cast<VirtualTable*>(table)->source->trace->ticks());
    std::string operators;
    for (int i = 0; i < info->nConstraint; ++i) {
        const auto& constraint = info->aConstraint[i];
        char op = 0;
        switch (constraint.op) {
            case SQLITE_INDEX_CONSTRAINT_EQ:
                op = '=';
                break;
            case SQLITE_INDEX_CONSTRAINT_GT:
            case SQLITE_INDEX_CONSTRAINT_GE:
                op = '>';
                break;
            case SQLITE_INDEX_CONSTRAINT_LT:
            case SQLITE_INDEX_CONSTRAINT_LE:
                op = '<';
                break;
            default:
                break;
        }
        if (op == 0 || constraint.usable == 0 || constraint.iColumn != 0)
            continue;
        operators += op;
        info->aConstraintUsage[i].argvIndex = static_cast<int>(operators.size());
        ticks = op == '=' ? 1 : ticks / 2;
    }
    info->idxStr = sqlite3_mprintf("%s", operators.c_str());
    info->needToFreeIdxStr = 1;
    info->estimatedCost = ticks * rows_a_tick;
    info->orderByConsumed =
        info->nOrderBy == 1 && info->aOrderBy[0].iColumn == 0 && info->aOrderBy[0].desc == 0 ? 1
                                                                                             : 0;
    return info->idxStr == nullptr ? SQLITE_NOMEM : SQLITE_OK;
}

int filter(
    sqlite3_vtab_cursor* cursor, int, const char* operators, int count, sqlite3_value** values) {
    Cursor& ours = of(cursor);
    return guarded(cursor->pVtab, [&] {
        const replay::TraceReader& trace = *ours.source().trace;
        replay::require_kept(trace, ours.source().table.name());
        auto first = static_cast<double>(trace.first());
        auto last = static_cast<double>(trace.last());
        for (int i = 0; i < count; ++i) {
            const int type = sqlite3_value_type(values[i]);
            if (type != SQLITE_INTEGER && type != SQLITE_FLOAT)
                continue;  // texts come behind all numbers: SQLite knows
            const double value = sqlite3_value_double(values[i]);
            if (operators[i] != '<')
                first = std::max(first, std::floor(value));
            if (operators[i] != '>')
                last = std::min(last, std::ceil(value));
        }
        if (first <= last)
            ours.start(static_cast<std::uint64_t>(first), static_cast<std::uint64_t>(last));
        else
            ours.start(1, 0);
    });
}

int next(sqlite3_vtab_cursor* cursor) {
    return guarded(cursor->pVtab, [&] { of(cursor).next(); });
}

int eof(sqlite3_vtab_cursor* cursor) {
    return of(cursor).at_end() ? 1 : 0;
}

int row_id(sqlite3_vtab_cursor* cursor, sqlite3_int64* id) {
    *id = of(cursor).number;
    return SQLITE_OK;
}

struct Answer {
    sqlite3_context* context;

    void operator()(std::monostate) const { sqlite3_result_null(context); }

    void operator()(bool value) const { sqlite3_result_int(context, value ? 1 : 0); }

    void operator()(std::int64_t value) const { sqlite3_result_int64(context, value); }

    void operator()(std::uint64_t value) const {
        if (value <= static_cast<std::uint64_t>(std::numeric_limits<std::int64_t>::max()))
            sqlite3_result_int64(context, static_cast<sqlite3_int64>(value));
        else
            (*this)(std::to_string(value));
    }

    void operator()(float value) const {
        sqlite3_result_double(context, static_cast<double>(value));
    }

    void operator()(double value) const { sqlite3_result_double(context, value); }

    void operator()(const std::string& value) const {
        sqlite3_result_text64(context, value.data(), value.size(), SQLITE_TRANSIENT, SQLITE_UTF8);
    }
};

int column(sqlite3_vtab_cursor* cursor, sqlite3_context* context, int index) {
    const Cursor& ours = of(cursor);
    std::visit(Answer{context}, ours.rows[ours.row][static_cast<std::size_t>(index)]);
    return SQLITE_OK;
}

sqlite3_module make_module() {
    sqlite3_module module{};
    // Without xCreate the table is there under its own name, and nobody can make another one.
    module.xConnect = connect;
    module.xDisconnect = disconnect;
    module.xBestIndex = best_index;
    module.xOpen = open;
    module.xClose = close;
    module.xFilter = filter;
    module.xNext = next;
    module.xEof = eof;
    module.xColumn = column;
    module.xRowid = row_id;
    return module;
}

}  // namespace

const sqlite3_module* tick_table_module() {
    static const sqlite3_module module = make_module();
    return &module;
}

}  // namespace reprise::exchange

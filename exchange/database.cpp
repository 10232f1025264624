#include "exchange/database.h"

#include <fmt/format.h>
#include <sqlite3.h>

#include "exchange/tick_table.h"
#include "world/check.h"

namespace reprise::exchange {

namespace {

using Statement = std::unique_ptr<sqlite3_stmt, int (*)(sqlite3_stmt*)>;

replay::Value value_in(sqlite3_stmt* statement, int column) {
    switch (sqlite3_column_type(statement, column)) {
        case SQLITE_INTEGER:
            return static_cast<std::int64_t>(sqlite3_column_int64(statement, column));
        case SQLITE_FLOAT:
            return sqlite3_column_double(statement, column);
        case SQLITE_NULL:
            return {};
        default: {
            const void* text = sqlite3_column_blob(statement, column);
            const auto size = static_cast<std::size_t>(sqlite3_column_bytes(statement, column));
            return std::string(static_cast<const char*>(text), text == nullptr ? 0 : size);
        }
    }
}

/// What stands behind `prefix` in SQLite's message.
std::string name_in(const std::string& message, const std::string& prefix) {
    if (!message.starts_with(prefix))
        return "";
    const std::string name = message.substr(prefix.size());
    return name.substr(name.rfind('.') + 1);  // without an alias in front
}

}  // namespace

struct Database::Connection {
    std::vector<std::unique_ptr<TickTable>> tables;
    sqlite3* database = nullptr;

    explicit Connection(replay::TraceReader& trace) {
        check(sqlite3_open(":memory:", &database));
        for (const std::string& name : replay::Table::names()) {
            tables.push_back(std::make_unique<TickTable>(
                TickTable{&trace, replay::Table(name, {}, trace.episode().step_ns)}));
            check(sqlite3_create_module(
                database, name.c_str(), tick_table_module(), tables.back().get()));
        }
    }

    ~Connection() { sqlite3_close(database); }

    Connection(const Connection&) = delete;
    Connection& operator=(const Connection&) = delete;

    void check(int code) const {
        if (code != SQLITE_OK)
            throw world::Error("SQL: " + std::string(sqlite3_errmsg(database)));
    }

    /// SQLite's message, with a suggestion.
    [[noreturn]] void fail() const {
        const std::string message = sqlite3_errmsg(database);
        std::string suggestion;
        if (const std::string table = name_in(message, "no such table: "); !table.empty()) {
            const auto names = replay::Table::names();
            suggestion = world::did_you_mean(table, names);
            if (suggestion.empty())
                suggestion = fmt::format("; there are {}", fmt::join(names, ", "));
        }
        if (const std::string column = name_in(message, "no such column: "); !column.empty()) {
            std::vector<std::string> names;
            for (const auto& one : tables)
                names.insert(names.end(), one->table.columns().begin(), one->table.columns().end());
            suggestion = world::did_you_mean(column, names);
            if (suggestion.empty())
                suggestion = "; without a statement, `reprise query T.mcap` lists the columns";
        }
        throw world::Error("SQL: " + message + suggestion);
    }

    Statement prepare(const std::string& sql) const {
        sqlite3_stmt* made = nullptr;
        const char* rest = nullptr;
        const int code = sqlite3_prepare_v2(
            database, sql.c_str(), static_cast<int>(sql.size() + 1), &made, &rest);
        Statement statement(made, sqlite3_finalize);
        if (code != SQLITE_OK)
            fail();
        if (statement == nullptr)
            throw world::Error("SQL: expected a statement, such as: select count(*) from ticks");
        if (std::string(rest).find_first_not_of(" \t\r\n;") != std::string::npos)
            throw world::Error("SQL: expected one statement, there are more");
        if (sqlite3_stmt_readonly(statement.get()) == 0)
            throw world::Error("SQL: a trace is only read; expected a select");
        return statement;
    }
};

Database::Database(replay::TraceReader& trace) : connection_(std::make_unique<Connection>(trace)) {}

Database::~Database() = default;

void Database::query(const std::string& sql, const Columns& columns, const Row& row) {
    const Statement statement = connection_->prepare(sql);
    const int count = sqlite3_column_count(statement.get());
    std::vector<std::string> names;
    for (int i = 0; i < count; ++i)
        names.emplace_back(sqlite3_column_name(statement.get(), i));
    columns(names);
    std::vector<replay::Value> values(names.size());
    int code = sqlite3_step(statement.get());
    for (; code == SQLITE_ROW; code = sqlite3_step(statement.get())) {
        for (int i = 0; i < count; ++i)
            values[static_cast<std::size_t>(i)] = value_in(statement.get(), i);
        row(values);
    }
    if (code != SQLITE_DONE)
        connection_->fail();
}

std::string Database::tables() const {
    std::string text;
    for (const auto& one : connection_->tables)
        text += fmt::format("{}({})\n", one->table.name(), fmt::join(one->table.columns(), ", "));
    return text;
}

}  // namespace reprise::exchange

#include "exchange/database.h"

#include <set>
#include <string>
#include <variant>

#include <fmt/format.h>
#include <sqlite3.h>

#include "exchange/tick_table.h"
#include "replay/table/whole_tables.h"
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
    replay::TraceReader* trace_read;
    std::set<std::string> loaded;

    explicit Connection(replay::TraceReader& trace) : trace_read(&trace) {
        check(sqlite3_open(":memory:", &database));
        for (const std::string& name : replay::Table::names()) {
            tables.push_back(std::make_unique<TickTable>(TickTable{
                &trace,
                replay::Table(
                    name, {}, trace.episode().step_ns, {&trace.recording().town, nullptr})}));
            check(sqlite3_create_module(
                database, name.c_str(), tick_table_module(), tables.back().get()));
        }
    }

    ~Connection() { sqlite3_close(database); }

    /// Tables that no tick has are copied, when a statement first names them.
    void load_whole_tables(const std::string& sql) {
        for (const std::string& name : replay::whole_table_names())
            if (sql.find(name) != std::string::npos && loaded.insert(name).second)
                load(read_whole_table(*trace_read, name));
    }

    void load(const replay::WholeTable& table) const {
        run(fmt::format("create table {}(\"{}\")", table.name, fmt::join(table.columns, "\", \"")));
        const std::vector<std::string> marks(table.columns.size(), "?");
        sqlite3_stmt* made = nullptr;
        const std::string insert =
            fmt::format("insert into {} values({})", table.name, fmt::join(marks, ","));
        check(sqlite3_prepare_v2(database, insert.c_str(), -1, &made, nullptr));
        const Statement statement(made, sqlite3_finalize);
        run("begin");
        for (const auto& row : table.rows) {
            for (std::size_t i = 0; i < row.size(); ++i)
                bind(made, static_cast<int>(i) + 1, row[i]);
            if (sqlite3_step(made) != SQLITE_DONE)
                check(sqlite3_errcode(database));
            sqlite3_reset(made);
        }
        run("commit");
    }

    /// A number, a text, or nothing: all that these tables hold.
    static void bind(sqlite3_stmt* statement, int place, const replay::Value& value) {
        if (const auto* whole = std::get_if<std::int64_t>(&value))
            sqlite3_bind_int64(statement, place, *whole);
        else if (const auto* real = std::get_if<double>(&value))
            sqlite3_bind_double(statement, place, *real);
        else if (const auto* text = std::get_if<std::string>(&value))
            sqlite3_bind_text(
                statement, place, text->data(), static_cast<int>(text->size()), SQLITE_TRANSIENT);
        else
            sqlite3_bind_null(statement, place);
    }

    void run(const std::string& statement) const {
        check(sqlite3_exec(database, statement.c_str(), nullptr, nullptr, nullptr));
    }

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
            std::vector<std::string> names = replay::Table::names();
            names.insert(names.end(),
                         replay::whole_table_names().begin(),
                         replay::whole_table_names().end());
            suggestion = world::did_you_mean(table, names);
            if (suggestion.empty())
                suggestion = fmt::format("; there are {}", fmt::join(names, ", "));
        }
        if (const std::string column = name_in(message, "no such column: "); !column.empty()) {
            std::vector<std::string> names;
            for (const auto& one : tables)
                names.insert(names.end(), one->table.columns().begin(), one->table.columns().end());
            suggestion = world::did_you_mean(column, names);
            if (column == "lane_s")  // as records call it, each of another point
                suggestion = " (it is rear_axle_s or front_s [m], of the front bumper)";
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
    connection_->load_whole_tables(sql);
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
    return text + "lanes and actors: what stands behind the numbers, such as select * from lanes\n";
}

}  // namespace reprise::exchange

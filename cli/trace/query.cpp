#include "cli/trace/query.h"

#include "cli/process/guard.h"
#include "cli/process/output.h"
#include "cli/trace/level_note.h"
#include "exchange/database.h"
#include "replay/trace_reader.h"

namespace reprise::cli {

namespace {

using Values = std::span<const replay::Value>;

void append_csv_row(Values values, std::string& out) {
    for (const replay::Value& value : values) {
        if (&value != values.data())
            out += ',';
        replay::append_csv(value, out);
    }
    out += '\n';
}

void append_json_row(const std::vector<std::string>& names, Values values, std::string& out) {
    for (std::size_t i = 0; i < names.size(); ++i) {
        out += i == 0 ? '{' : ',';
        replay::append_json(std::string_view(names[i]), out);
        out += ':';
        replay::append_json(values[i], out);
    }
    out += "}\n";
}

}  // namespace

int query(const QueryOptions& options) {
    end_quietly_when_nobody_reads();
    replay::TraceReader trace(options.trace);
    exchange::Database database(trace);
    Output output("-");
    if (options.sql.empty()) {
        output.text = database.tables();
        output.finish();
        return exit_good;
    }
    print_level_note(trace);
    const bool csv = options.format == "csv";
    std::vector<std::string> names;
    database.query(
        options.sql,
        [&](const std::vector<std::string>& columns) {
            names = columns;
            if (csv)
                append_csv_row(std::vector<replay::Value>(names.begin(), names.end()), output.text);
        },
        [&](Values values) {
            if (csv)
                append_csv_row(values, output.text);
            else
                append_json_row(names, values, output.text);
            output.flush_if_large();
        });
    output.finish();
    return exit_good;
}

}  // namespace reprise::cli

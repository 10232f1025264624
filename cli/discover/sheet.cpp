#include "cli/discover/sheet.h"

#include <algorithm>
#include <cctype>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace reprise::cli {

namespace {

std::string lower(std::string text) {
    for (char& letter : text)
        letter = static_cast<char>(std::tolower(static_cast<unsigned char>(letter)));
    return text;
}

bool is_number(const Sheet::Cell& cell) {
    return std::holds_alternative<double>(cell) || std::holds_alternative<std::int64_t>(cell);
}

/// One line: cells side by side, each as wide as its column.
void add_line(std::string& text,
              const std::vector<std::string>& cells,
              const std::vector<std::size_t>& widths,
              const std::vector<bool>& to_the_right) {
    for (std::size_t i = 0; i < cells.size(); ++i) {
        const std::string gap(widths[i] - std::min(widths[i], cells[i].size()), ' ');
        text += (i == 0 ? "" : "  ") + (to_the_right[i] ? gap + cells[i] : cells[i] + gap);
    }
    text.erase(text.find_last_not_of(' ') + 1);
    text += '\n';
}

}  // namespace

std::string Sheet::shown(const Cell& cell, const Column& column) const {
    if (const auto* text = std::get_if<std::string>(&cell))
        return text->empty() ? "-" : *text;
    if (const auto* real = std::get_if<double>(&cell))
        return fmt::format("{:.{}f}", *real, column.digits);
    if (const auto* whole = std::get_if<std::int64_t>(&cell))
        return fmt::format("{}", *whole);
    if (const auto* flag = std::get_if<bool>(&cell))
        return *flag ? "yes" : "no";
    return "-";
}

void Sheet::keep(const std::string& text) {
    const std::string wanted = lower(text);
    std::erase_if(rows_, [&](const std::vector<Cell>& row) {
        for (std::size_t i = 0; i < row.size(); ++i)
            if (lower(shown(row[i], columns_[i])).find(wanted) != std::string::npos)
                return false;
        return true;
    });
}

std::string Sheet::text() const {
    std::vector<std::vector<std::string>> lines(1);
    std::vector<std::size_t> widths;
    std::vector<bool> to_the_right;
    for (const Column& column : columns_) {
        lines.front().push_back(column.heading);
        widths.push_back(column.heading.size());
        to_the_right.push_back(false);
    }
    for (const auto& row : rows_) {
        std::vector<std::string>& line = lines.emplace_back();
        for (std::size_t i = 0; i < row.size(); ++i) {
            line.push_back(shown(row[i], columns_[i]));
            widths[i] = std::max(widths[i], line.back().size());
            to_the_right[i] = to_the_right[i] || is_number(row[i]);
        }
    }
    std::string text;
    for (const auto& line : lines)
        add_line(text, line, widths, to_the_right);
    return text;
}

std::string Sheet::json() const {
    nlohmann::ordered_json list = nlohmann::ordered_json::array();
    for (const auto& row : rows_) {
        nlohmann::ordered_json& object = list.emplace_back(nlohmann::ordered_json::object());
        for (std::size_t i = 0; i < row.size(); ++i)
            std::visit(
                [&](const auto& value) {
                    if constexpr (std::is_same_v<std::decay_t<decltype(value)>, std::monostate>)
                        object[columns_[i].key] = nullptr;
                    else
                        object[columns_[i].key] = value;
                },
                row[i]);
    }
    return list.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

}  // namespace reprise::cli

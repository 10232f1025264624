#include "cli/golden/junit.h"

#include <fmt/format.h>
#include <pugixml.hpp>

#include "files/output_file.h"

namespace reprise::cli {

namespace {

/// How many bytes of a well-formed UTF-8 character begin here; 0: none does.
std::size_t character_at(const std::string& text, std::size_t at) {
    const auto byte = [&](std::size_t i) {
        return i < text.size() ? static_cast<unsigned char>(text[i]) : 0u;
    };
    const unsigned lead = byte(at);
    const std::size_t size = lead < 0x80                   ? 1
                             : lead >= 0xc2 && lead < 0xe0 ? 2
                             : lead >= 0xe0 && lead < 0xf0 ? 3
                             : lead >= 0xf0 && lead < 0xf5 ? 4
                                                           : 0;
    for (std::size_t i = 1; i < size; ++i)
        if ((byte(at + i) & 0xc0) != 0x80)
            return 0;
    const bool overlong =
        (lead == 0xe0 && byte(at + 1) < 0xa0) || (lead == 0xf0 && byte(at + 1) < 0x90);
    const bool surrogate = lead == 0xed && byte(at + 1) >= 0xa0;
    const bool too_large = lead == 0xf4 && byte(at + 1) >= 0x90;
    const bool not_a_character = lead == 0xef && byte(at + 1) == 0xbf && byte(at + 2) >= 0xbe;
    return overlong || surrogate || too_large || not_a_character ? 0 : size;
}

/// Scenarios print what they like; XML takes neither control characters nor broken UTF-8.
std::string clean(const std::string& text) {
    std::string out;
    for (std::size_t at = 0; at < text.size();) {
        const std::size_t size = character_at(text, at);
        const char c = text[at];
        const bool control = static_cast<unsigned char>(c) < 0x20 || c == 0x7f;
        if (size == 0)
            out += '?';
        else if (!control || c == '\n' || c == '\t')
            out.append(text, at, size);
        at += std::max<std::size_t>(size, 1);
    }
    return out;
}

void set(pugi::xml_node node, const char* name, const std::string& value) {
    node.append_attribute(name).set_value(clean(value).c_str());
}

const char* failure_type(CaseResult result) {
    switch (result) {
        case CaseResult::changed:
            return "changed";
        case CaseResult::nondeterministic:
            return "nondeterministic";
        case CaseResult::failed:
            return "failed";
        case CaseResult::no_golden:
            return "no_golden";
        case CaseResult::not_run:
            return "not_run";
        case CaseResult::orphan:
            return "orphan";
        default:
            return "";
    }
}

void add_properties(pugi::xml_node node, const CaseReport& report) {
    pugi::xml_node properties = node.append_child("properties");
    const auto add = [&](const std::string& name, const std::string& value) {
        pugi::xml_node property = properties.append_child("property");
        set(property, "name", name);
        set(property, "value", value);
    };
    for (const auto& [name, value] : report.starts)
        add(name, value);
    if (report.result != CaseResult::orphan)
        add("command", command_line(run_words(report.tested, report.given, {}, report.drivers)));
}

void add_case(pugi::xml_node suite, const CaseReport& report) {
    pugi::xml_node node = suite.append_child("testcase");
    const std::filesystem::path label = report.tested.label();
    set(node, "classname", label.has_parent_path() ? label.parent_path().string() : ".");
    set(node, "name", label.filename().string());
    set(node, "time", fmt::format("{:.3f}", report.seconds));
    add_properties(node, report);
    if (report.result == CaseResult::passed)
        return;
    const bool error = report.result == CaseResult::error;
    pugi::xml_node problem = node.append_child(error ? "error" : "failure");
    set(problem, "type", error ? report.error_kind : failure_type(report.result));
    set(problem, "message", report.headline);
    problem.text().set(clean(report.text).c_str());
}

/// Into a string.
struct Text : pugi::xml_writer {
    std::string text;

    void write(const void* data, std::size_t size) override {
        text.append(static_cast<const char*>(data), size);
    }
};

}  // namespace

void write_junit(const std::filesystem::path& path,
                 const std::vector<CaseReport>& reports,
                 double seconds) {
    std::size_t failures = 0;
    std::size_t errors = 0;
    for (const CaseReport& report : reports) {
        errors += report.result == CaseResult::error ? 1 : 0;
        failures +=
            report.result != CaseResult::error && report.result != CaseResult::passed ? 1 : 0;
    }
    pugi::xml_document document;
    pugi::xml_node declaration = document.append_child(pugi::node_declaration);
    declaration.append_attribute("version").set_value("1.0");
    declaration.append_attribute("encoding").set_value("UTF-8");
    pugi::xml_node suites = document.append_child("testsuites");
    pugi::xml_node suite = suites.append_child("testsuite");
    for (pugi::xml_node node : {suites, suite}) {
        set(node, "name", "reprise");
        set(node, "tests", std::to_string(reports.size()));
        set(node, "failures", std::to_string(failures));
        set(node, "errors", std::to_string(errors));
        set(node, "time", fmt::format("{:.3f}", seconds));
    }
    for (const CaseReport& report : reports)
        add_case(suite, report);
    Text out;
    document.save(out, "  ");
    files::write_file(path, "the report", out.text);
}

}  // namespace reprise::cli

// A trace of another format is refused, so a schema that changes must count the format up: bytes of
// two schemas under one number would be read as what they are not.
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>
#include <string>
#include <vector>

#include <flatbuffers/reflection.h>
#include <gmock/gmock.h>

#include "replay/trace_format.h"
#include "world/episode_bfbs_generated.h"
#include "world/tick_bfbs_generated.h"
#include "world/town_bfbs_generated.h"
#include "world/traffic_bfbs_generated.h"

namespace reprise::test {
namespace {

using Lines = std::set<std::string>;

std::string short_name(const flatbuffers::String& name) {
    const std::string text = name.str();
    return text.substr(text.rfind('.') + 1);
}

std::string padded(std::int64_t number) {
    const std::string text = std::to_string(number);
    return std::string(3 - std::min<std::size_t>(3, text.size()), ' ') + text;
}

std::string type_name(const reflection::Schema& schema,
                      const reflection::Type& type,
                      reflection::BaseType base) {
    if (base == reflection::Vector)
        return "[" + type_name(schema, type, type.element()) + "]";
    const auto index = static_cast<flatbuffers::uoffset_t>(type.index());
    if (base == reflection::Obj)
        return short_name(*schema.objects()->Get(index)->name());
    const std::string scalar = reflection::EnumNameBaseType(base);
    return type.index() >= 0 ? short_name(*schema.enums()->Get(index)->name()) + ":" + scalar
                             : scalar;
}

/// One line for each fact that a trace depends on; each says all that it is about.
void describe(const reflection::Schema& schema, const reflection::Object& object, Lines& lines) {
    const std::string name = short_name(*object.name());
    if (object.is_struct())
        lines.insert("struct " + name + " has " + std::to_string(object.bytesize()) +
                     " bytes, aligned to " + std::to_string(object.minalign()));
    for (const reflection::Field* field : *object.fields()) {
        std::string line = object.is_struct()
                               ? "struct " + name + " byte " + padded(field->offset())
                               : "table " + name + " field " + padded(field->id());
        line += " " + field->name()->str() + " " +
                type_name(schema, *field->type(), field->type()->base_type());
        if (field->default_integer() != 0)
            line += " = " + std::to_string(field->default_integer());
        if (field->default_real() != 0)
            line += " = " + std::to_string(field->default_real());
        line += field->required() ? " required" : "";
        line += field->deprecated() ? " deprecated" : "";
        lines.insert(line);
    }
}

void describe(const std::string& file, const reflection::Schema& schema, Lines& lines) {
    lines.insert("file " + file + ".fbs is " + schema.file_ident()->str() + ", root " +
                 schema.root_table()->name()->str());
    for (const reflection::Object* object : *schema.objects())
        describe(schema, *object, lines);
    for (const reflection::Enum* type : *schema.enums())
        for (const reflection::EnumVal* value : *type->values())
            lines.insert("enum " + short_name(*type->name()) + " value " + padded(value->value()) +
                         " " + value->name()->str());
}

std::string format_line() {
    return "format " + std::to_string(replay::format::version);
}

/// Of the schemas as they are embedded in traces.
Lines facts() {
    Lines lines{format_line()};
    describe("tick", *reflection::GetSchema(world::TickBinarySchema::data()), lines);
    describe("traffic", *reflection::GetSchema(world::TrafficBinarySchema::data()), lines);
    describe("town", *reflection::GetSchema(world::TownBinarySchema::data()), lines);
    describe("episode", *reflection::GetSchema(world::EpisodeBinarySchema::data()), lines);
    return lines;
}

std::string joined(const std::vector<std::string>& lines) {
    std::string text;
    for (const std::string& line : lines)
        text += "  " + line + "\n";
    return text;
}

Lines read_golden() {
    Lines lines;
    std::ifstream file(REPRISE_SCHEMA_GOLDEN);
    for (std::string line; std::getline(file, line);)
        if (!line.empty() && !line.starts_with('#'))
            lines.insert(line);
    return lines;
}

TEST(SchemaGolden, ChangesOnlyWithTheFormatsVersion) {
    const Lines golden = read_golden();
    const Lines found = facts();
    if (golden == found)
        return;
    std::vector<std::string> changes;
    std::set_difference(
        golden.begin(), golden.end(), found.begin(), found.end(), std::back_inserter(changes));
    for (std::string& line : changes)
        line = "- " + line;
    const std::size_t gone = changes.size();
    std::set_difference(
        found.begin(), found.end(), golden.begin(), golden.end(), std::back_inserter(changes));
    for (std::size_t i = gone; i < changes.size(); ++i)
        changes[i] = "+ " + changes[i];
    ASSERT_FALSE(golden.contains(format_line()))
        << "Count up `version` in replay/trace_format.h: traces of today are not of this schema:\n"
        << joined(changes);
    const std::string accepted = testing::TempDir() + "schema.golden";
    std::ofstream file(accepted);
    file << "# What traces depend on; tests/replay/schema_golden_test.cpp compares it.\n";
    for (const std::string& line : found)
        file << line << "\n";
    ADD_FAILURE() << joined(changes) << "To accept it:  cp " << accepted << " "
                  << REPRISE_SCHEMA_GOLDEN;
}

}  // namespace
}  // namespace reprise::test

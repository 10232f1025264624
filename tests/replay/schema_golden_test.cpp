// What is in traces that exist cannot be changed any more. flatc --conform sees neither a grown
// struct, nor a removed or newly required field, nor another file identifier; this does.
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include <flatbuffers/reflection.h>
#include <gmock/gmock.h>

#include "world/episode_bfbs_generated.h"
#include "world/tick_bfbs_generated.h"
#include "world/town_bfbs_generated.h"
#include "world/traffic_bfbs_generated.h"

namespace reprise::test {
namespace {

using Lines = std::set<std::string>;
using testing::ElementsAre;
using testing::IsEmpty;

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

/// Of the schemas as they are embedded in traces.
Lines facts() {
    Lines lines;
    describe("tick", *reflection::GetSchema(world::TickBinarySchema::data()), lines);
    describe("traffic", *reflection::GetSchema(world::TrafficBinarySchema::data()), lines);
    describe("town", *reflection::GetSchema(world::TownBinarySchema::data()), lines);
    describe("episode", *reflection::GetSchema(world::EpisodeBinarySchema::data()), lines);
    return lines;
}

/// "struct CarState": what a line is about.
std::string subject(const std::string& line) {
    return line.substr(0, line.find(' ', line.find(' ') + 1));
}

/// How a schema became another one.
struct Change {
    std::vector<std::string> breaking;  ///< "- " what is gone, "+ " what must not come
    std::vector<std::string> added;     ///< what older traces simply do not have
};

/// "struct S byte   4 reserved UInt" and "struct S byte   4 kind Kind:UInt" are the same bytes:
/// what was reserved is 0 in older traces, so it may get a meaning for which 0 says "as before".
bool names_reserved_bytes(const std::string& reserved, const std::string& named) {
    const auto place = [](const std::string& line) {
        return line.substr(0, line.rfind(' ', line.rfind(' ') - 1));
    };
    const auto type = [](const std::string& line) {
        return line.substr(line.find_last_of(" :") + 1);
    };
    return reserved.starts_with("struct ") && reserved.find(" reserved") != std::string::npos &&
           place(reserved) == place(named) && type(reserved) == type(named);
}

bool any_of(const Lines& lines, const std::function<bool(const std::string&)>& holds) {
    return std::any_of(lines.begin(), lines.end(), holds);
}

Change compare(const Lines& golden, const Lines& found) {
    Change change;
    std::set<std::string> known;
    for (const std::string& line : golden) {
        known.insert(subject(line));
        const bool named = any_of(found, [&](const std::string& other) {
            return other != line && names_reserved_bytes(line, other);
        });
        if (!found.contains(line) && !named)
            change.breaking.push_back("- " + line);
    }
    for (const std::string& line : found) {
        if (golden.contains(line))
            continue;
        const bool old = known.contains(subject(line));
        const bool frozen = line.starts_with("struct ") || line.ends_with(" required");
        const bool was_reserved = any_of(
            golden, [&](const std::string& other) { return names_reserved_bytes(other, line); });
        if (old && frozen && !was_reserved)
            change.breaking.push_back("+ " + line);
        else
            change.added.push_back(line);
    }
    return change;
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

TEST(SchemaGolden, HoldsSoThatOlderTracesStayReadable) {
    const Change change = compare(read_golden(), facts());
    EXPECT_THAT(change.breaking, IsEmpty())
        << "This change makes traces that exist unreadable:\n"
        << joined(change.breaking)
        << "Structs are frozen: make a new one and a new table field for it. Tables only grow, by\n"
           "fields with the next id that are not required; enums only grow at their end. What is\n"
           "no longer written stays, as (deprecated).";
    if (!change.breaking.empty() || change.added.empty())
        return;
    const std::string accepted = testing::TempDir() + "schema.golden";
    std::ofstream file(accepted);
    file << "# What traces depend on; tests/replay/schema_golden_test.cpp compares it.\n";
    for (const std::string& line : facts())
        file << line << "\n";
    ADD_FAILURE()
        << "New in the schema, and harmless to older traces (they do not have it: readers\n"
           "must live without):\n"
        << joined(change.added) << "To accept it:  cp " << accepted << " " << REPRISE_SCHEMA_GOLDEN;
}

TEST(SchemaGolden, TellsWhatBreaksFromWhatIsNew) {
    const Lines before{"struct S has 8 bytes, aligned to 8",
                       "struct S byte   0 x Double",
                       "struct R byte   4 reserved UInt",
                       "table T field   0 a UInt",
                       "enum E value   0 zero"};
    const auto with = [&](const std::string& line) {
        Lines after = before;
        after.insert(line);
        return compare(before, after);
    };
    const auto without = [&](const std::string& line) {
        Lines after = before;
        after.erase(line);
        return compare(before, after);
    };
    EXPECT_THAT(compare(before, before).breaking, IsEmpty());
    EXPECT_THAT(with("table T field   1 b UInt").breaking, IsEmpty());
    EXPECT_THAT(with("table T field   1 b UInt").added, ElementsAre("table T field   1 b UInt"));
    EXPECT_THAT(with("struct New byte   0 y Double").breaking, IsEmpty());
    EXPECT_THAT(with("enum E value   1 one").breaking, IsEmpty());
    EXPECT_THAT(with("struct S byte   8 y Double").breaking,
                ElementsAre("+ struct S byte   8 y Double"));
    EXPECT_THAT(with("table T field   1 b String required").breaking,
                ElementsAre("+ table T field   1 b String required"));
    Lines named = before;
    named.erase("struct R byte   4 reserved UInt");
    EXPECT_THAT(compare(before, named).breaking, ElementsAre("- struct R byte   4 reserved UInt"));
    named.insert("struct R byte   4 kind Kind:UInt");
    EXPECT_THAT(compare(before, named).breaking, IsEmpty());
    EXPECT_THAT(compare(before, named).added, ElementsAre("struct R byte   4 kind Kind:UInt"));
    named.erase("struct R byte   4 kind Kind:UInt");
    named.insert("struct R byte   4 share Float");
    EXPECT_THAT(compare(before, named).breaking.size(), 2U);
    for (const std::string& line : before)
        EXPECT_THAT(without(line).breaking, ElementsAre("- " + line));
}

}  // namespace
}  // namespace reprise::test

#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <regex>
#include <string>

#include <flatbuffers/reflection.h>
#include <gtest/gtest.h>

#include "world/episode_bfbs_generated.h"
#include "world/tick.h"
#include "world/tick_bfbs_generated.h"
#include "world/town_bfbs_generated.h"
#include "world/town_generated.h"
#include "world/traffic_bfbs_generated.h"

namespace reprise {

namespace {

/// The schemas as they are embedded in traces, by file. common.fbs has no root: its structs are in
/// all.
std::map<std::string, const reflection::Schema*> schemas() {
    return {{"tick", reflection::GetSchema(world::TickBinarySchema::data())},
            {"traffic", reflection::GetSchema(world::TrafficBinarySchema::data())},
            {"town", reflection::GetSchema(world::TownBinarySchema::data())},
            {"episode", reflection::GetSchema(world::EpisodeBinarySchema::data())}};
}

template <typename Visit>
void for_each_object(Visit&& visit) {
    for (const auto& [file, schema] : schemas())
        for (const reflection::Object* object : *schema->objects())
            visit(file, *schema, *object);
}

int size_of(const reflection::Schema& schema, const reflection::Type& type) {
    if (type.base_type() == reflection::Obj)
        return schema.objects()->Get(static_cast<unsigned>(type.index()))->bytesize();
    return static_cast<int>(flatbuffers::GetTypeSize(type.base_type()));
}

/// Name without its namespace.
std::string short_name(const reflection::Object& object) {
    const std::string name = object.name()->str();
    return name.substr(name.rfind('.') + 1);
}

std::string text_of(const std::filesystem::path& path) {
    std::ifstream file(path);
    return {std::istreambuf_iterator<char>(file), {}};
}

std::vector<std::filesystem::path> schema_files() {
    std::vector<std::filesystem::path> files;
    for (const auto& entry : std::filesystem::directory_iterator(REPRISE_WORLD_DIR))
        if (entry.path().extension() == ".fbs")
            files.push_back(entry.path());
    return files;
}

/// What the comments in world/*.fbs say: "struct Vec3 { ... }   // 24 bytes".
std::map<std::string, int> documented_sizes() {
    const std::regex line(R"(struct (\w+) \{[^\n]*//\s*(\d+))");
    std::map<std::string, int> sizes;
    for (const std::filesystem::path& path : schema_files()) {
        const std::string text = text_of(path);
        for (std::sregex_iterator match(text.begin(), text.end(), line), end; match != end; ++match)
            sizes[(*match)[1]] = std::stoi((*match)[2]);
    }
    return sizes;
}

}  // namespace

TEST(Schema, HasNoPaddingInStructs) {
    int structs = 0;
    for_each_object([&](const std::string& file,
                        const reflection::Schema& schema,
                        const reflection::Object& object) {
        if (!object.is_struct())
            return;
        ++structs;
        int sum = 0;
        for (const reflection::Field* field : *object.fields())
            sum += size_of(schema, *field->type());
        EXPECT_EQ(sum, object.bytesize()) << file << ": " << object.name()->str();
    });
    EXPECT_GT(structs, 10);
}

TEST(Schema, HasNoUnionsAndNoFixedArrays) {
    for_each_object(
        [](const std::string& file, const reflection::Schema&, const reflection::Object& object) {
            for (const reflection::Field* field : *object.fields()) {
                const auto type = field->type()->base_type();
                const bool is_simple = type != reflection::Union && type != reflection::UType &&
                                       type != reflection::Array &&
                                       field->type()->element() != reflection::Union;
                EXPECT_TRUE(is_simple)
                    << file << ": " << object.name()->str() << '.' << field->name()->str();
            }
        });
}

TEST(Schema, KeepsTheSizesThatItsCommentsPromise) {
    const std::map<std::string, int> documented = documented_sizes();
    for_each_object(
        [&](const std::string& file, const reflection::Schema&, const reflection::Object& object) {
            if (!object.is_struct())
                return;
            const auto found = documented.find(short_name(object));
            ASSERT_NE(found, documented.end())
                << file << ": " << short_name(object) << " says no size";
            EXPECT_EQ(found->second, object.bytesize()) << file << ": " << short_name(object);
        });
}

/// Recorded for ever: a size that changes here breaks every trace that was ever written.
TEST(Schema, KeepsTheRecordedSizes) {
    EXPECT_EQ(sizeof(world::Vec3), 24u);
    EXPECT_EQ(sizeof(world::Quat), 32u);
    EXPECT_EQ(sizeof(world::Digest128), 16u);
    EXPECT_EQ(sizeof(world::Weather), 60u);
    EXPECT_EQ(sizeof(world::Control), 32u);
    EXPECT_EQ(sizeof(world::VehicleState), 160u);
    EXPECT_EQ(sizeof(world::WheelState), 48u);
    EXPECT_EQ(sizeof(world::Measurement), 112u);
    EXPECT_EQ(sizeof(world::Digests), 80u);
    EXPECT_EQ(sizeof(world::CarState), 56u);
    EXPECT_EQ(sizeof(world::WalkerState), 48u);
    EXPECT_EQ(sizeof(world::Link), 16u);
    EXPECT_EQ(sizeof(world::Building), 64u);
    EXPECT_EQ(sizeof(world::Tree), 48u);
}

/// Hashers and sorted vectors take structs as bytes: two equal structs must be equal bytes.
TEST(Schema, HasUniqueObjectRepresentationsUpToFloats) {
    EXPECT_TRUE(std::has_unique_object_representations_v<world::Digest128>);
    EXPECT_TRUE(std::is_trivially_copyable_v<world::VehicleState>);
    EXPECT_TRUE(std::is_trivially_copyable_v<world::CarState>);
    EXPECT_TRUE(std::is_trivially_copyable_v<world::Measurement>);
}

TEST(Schema, NamesItsFiles) {
    const auto all = schemas();
    EXPECT_EQ(all.at("tick")->file_ident()->str(), "RPTK");
    EXPECT_EQ(all.at("traffic")->file_ident()->str(), "RPTR");
    EXPECT_EQ(all.at("town")->file_ident()->str(), "RPTN");
    EXPECT_EQ(all.at("episode")->file_ident()->str(), "RPEP");
}

}  // namespace reprise

#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include <flatbuffers/flatbuffers.h>

namespace reprise::replay {

/// Two values of one field.
struct FieldDifference {
    std::string field;     ///< path, such as wheels[vehicle 1, index 2].rotation
    std::string expected;  ///< decimal, shortest that reads back the same; reals with hex bits
    std::string found;
    std::string distance;  ///< "1 unit in the last place apart", or ""
    std::uint32_t actor = 0;
};

/// How far reals may be apart, each in its own unit: by `bound`, or where one is larger than 1 by
/// that share of it. Directions are apart the short way round. All that is no real must be equal.
struct Tolerance {
    double bound = 0;
    double largest = 0;      ///< found so far: the difference, or its share
    std::string field = {};  ///< where that was, and both values
    std::string expected = {};
    std::string found = {};
};

/// Compares one field of two tables of the same type, all the way down, through FlatBuffers' type
/// tables: a field added to a schema is compared without a line here. Vectors of structs with an id
/// (id; actor; vehicle and index) are matched by it and must be sorted by it; others by position.
/// Both tables must have been verified. With a tolerance only what lies outside of it is a
/// difference; the largest that lies within is noted there.
std::vector<FieldDifference> differences(const flatbuffers::TypeTable& type,
                                         const void* expected,
                                         const void* found,
                                         std::string_view field,
                                         Tolerance* tolerance = nullptr);

/// Names of the table's fields.
std::vector<std::string_view> field_names(const flatbuffers::TypeTable& type);

}  // namespace reprise::replay

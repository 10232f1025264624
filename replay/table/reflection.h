// Private to the room: FlatBuffers' type tables, as far as ticks need them. A field that is added
// to a schema is compared, printed and queried without a line of code for it.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include <flatbuffers/minireflect.h>

#include "replay/table/value.h"

namespace reprise::replay::reflection {

using Bytes = const std::uint8_t*;

/// One field of a table or struct.
struct Field {
    const char* name = "";
    flatbuffers::ElementaryType type{};
    bool repeating = false;
    const flatbuffers::TypeTable* ref = nullptr;  ///< of an enum, struct or table
    std::size_t index = 0;
};

Field field_at(const flatbuffers::TypeTable& type, std::size_t index);
std::vector<Field> fields_of(const flatbuffers::TypeTable& type);
const Field* find_field(const std::vector<Field>& fields, std::string_view name);

/// Where the field lies in the object; null when a table does not have it.
Bytes address(const flatbuffers::TypeTable& type, Bytes object, const Field& field);

/// Where an offset leads to.
inline Bytes follow(Bytes offset) {
    return offset + flatbuffers::ReadScalar<flatbuffers::uoffset_t>(offset);
}

/// The text that an offset leads to; an absent one is empty.
std::string_view text_at(Bytes offset);

inline bool is_table(const Field& field) {
    return field.type == flatbuffers::ET_SEQUENCE && field.ref->st == flatbuffers::ST_TABLE;
}

/// The enumerator's name, or the number when there is none.
std::string enumerator(std::int64_t value, const flatbuffers::TypeTable* type);

/// A number, enumerator or text. `at` null: nothing. 32-bit numbers and smaller are int64, 64-bit
/// ones keep their sign.
Value value_at(const Field& field, Bytes at);

/// The fields that tell a vector's structs apart, in sorting order (id; actor; vehicle and index);
/// none: position does.
std::vector<Field> key_of(const Field& vector);

/// A vector's elements; none for an absent one.
struct Elements {
    Bytes first = nullptr;
    std::size_t count = 0;
    std::size_t stride = 0;

    Bytes at(std::size_t i) const { return first + i * stride; }
};

Elements elements_of(const Field& field, Bytes offset);

}  // namespace reprise::replay::reflection

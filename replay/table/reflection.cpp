#include "replay/table/reflection.h"

namespace reprise::replay::reflection {

Field field_at(const flatbuffers::TypeTable& type, std::size_t index) {
    const flatbuffers::TypeCode code = type.type_codes[index];
    return {type.names[index],
            static_cast<flatbuffers::ElementaryType>(code.base_type),
            code.is_repeating != 0,
            code.sequence_ref >= 0 ? type.type_refs[code.sequence_ref]() : nullptr,
            index};
}

std::vector<Field> fields_of(const flatbuffers::TypeTable& type) {
    std::vector<Field> fields;
    for (std::size_t i = 0; i < type.num_elems; ++i)
        fields.push_back(field_at(type, i));
    return fields;
}

const Field* find_field(const std::vector<Field>& fields, std::string_view name) {
    for (const Field& field : fields) {
        if (field.name == name)
            return &field;
    }
    return nullptr;
}

Bytes address(const flatbuffers::TypeTable& type, Bytes object, const Field& field) {
    if (type.st == flatbuffers::ST_STRUCT)
        return object + type.values[field.index];
    return reinterpret_cast<const flatbuffers::Table*>(object)->GetAddressOf(
        flatbuffers::FieldIndexToOffset(static_cast<flatbuffers::voffset_t>(field.index)));
}

std::string_view text_at(Bytes offset) {
    if (offset == nullptr)
        return {};
    const auto* string = reinterpret_cast<const flatbuffers::String*>(follow(offset));
    return {string->c_str(), string->size()};
}

std::string enumerator(std::int64_t value, const flatbuffers::TypeTable* type) {
    const char* name = flatbuffers::EnumName(value, type);
    return name != nullptr ? std::string(name) : std::to_string(value);
}

namespace {

template <typename Number>
Value whole_number(const Field& field, Bytes at) {
    const auto value = static_cast<std::int64_t>(flatbuffers::ReadScalar<Number>(at));
    if (field.ref != nullptr)
        return enumerator(value, field.ref);
    return value;
}

}  // namespace

Value value_at(const Field& field, Bytes at) {
    if (at == nullptr)
        return {};
    switch (field.type) {
        case flatbuffers::ET_BOOL:
            return flatbuffers::ReadScalar<std::uint8_t>(at) != 0;
        case flatbuffers::ET_UTYPE:
        case flatbuffers::ET_UCHAR:
            return whole_number<std::uint8_t>(field, at);
        case flatbuffers::ET_CHAR:
            return whole_number<std::int8_t>(field, at);
        case flatbuffers::ET_SHORT:
            return whole_number<std::int16_t>(field, at);
        case flatbuffers::ET_USHORT:
            return whole_number<std::uint16_t>(field, at);
        case flatbuffers::ET_INT:
            return whole_number<std::int32_t>(field, at);
        case flatbuffers::ET_UINT:
            return whole_number<std::uint32_t>(field, at);
        case flatbuffers::ET_LONG:
            return flatbuffers::ReadScalar<std::int64_t>(at);
        case flatbuffers::ET_ULONG:
            return flatbuffers::ReadScalar<std::uint64_t>(at);
        case flatbuffers::ET_FLOAT:
            return flatbuffers::ReadScalar<float>(at);
        case flatbuffers::ET_DOUBLE:
            return flatbuffers::ReadScalar<double>(at);
        case flatbuffers::ET_STRING:
            return std::string(text_at(at));
        case flatbuffers::ET_SEQUENCE:
            break;
    }
    return {};
}

std::vector<Field> key_of(const Field& vector) {
    if (vector.ref == nullptr || vector.ref->st != flatbuffers::ST_STRUCT)
        return {};
    const std::vector<Field> fields = fields_of(*vector.ref);
    for (const char* name : {"id", "actor"}) {
        if (const Field* field = find_field(fields, name))
            return {*field};
    }
    const Field* vehicle = find_field(fields, "vehicle");
    const Field* index = find_field(fields, "index");
    if (vehicle != nullptr && index != nullptr)
        return {*vehicle, *index};
    return {};
}

Elements elements_of(const Field& field, Bytes offset) {
    if (offset == nullptr)
        return {};
    const auto* vector = reinterpret_cast<const flatbuffers::Vector<std::uint8_t>*>(follow(offset));
    return {vector->Data(), vector->size(), flatbuffers::InlineSize(field.type, field.ref)};
}

}  // namespace reprise::replay::reflection

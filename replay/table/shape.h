// Private to the room: what is to be read of a noun, worked out once, so that reading it costs no
// searching.
#pragma once

#include <string>
#include <vector>

#include "replay/table/reflection.h"
#include "replay/table/selection.h"

namespace reprise::replay::reflection {

/// A field that is wanted, and what is wanted of it.
struct Shape {
    Field field;
    const flatbuffers::TypeTable* owner = nullptr;  ///< the type that has the field
    std::vector<Shape> members;                     ///< of a struct or table
    std::vector<Field> actors;                      ///< of an element: the fields that name actors
};

/// The wanted fields of a type. `used[i]` is set for every selected path that names one of them.
std::vector<Shape> shapes_of(const flatbuffers::TypeTable& type,
                             const Selection& selection,
                             std::vector<bool>& used);

/// Throws world::Error for the first path that names no field, with a suggestion.
void check_used(const Selection& selection, const std::vector<bool>& used);

/// Does this element of a list belong to the actor?
bool belongs_to(const Shape& list, Bytes element, std::uint32_t actor);

}  // namespace reprise::replay::reflection

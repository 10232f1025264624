#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "world/check.h"
#include "world/external/sensor.h"

namespace reprise::world {

/// What sensors of some kinds can be told by a name: in a rig file, in a scenario's rig, and in the
/// trace.
struct AttributeRow {
    std::string_view name;
    bool (*is_of)(SensorKind kind);
    double usual;
    double low;
    double high;
    std::string_view meaning;     ///< with its unit, for help texts
    std::string_view words = {};  ///< what 0, 1, ... are called, by commas; empty: numbers are said
};

/// All of all kinds, sorted by name.
std::span<const AttributeRow> attribute_rows();

/// Null where the kind has none of this name.
const AttributeRow* find_attribute(SensorKind kind, std::string_view name);

/// Those of a kind, for suggestions.
std::vector<std::string> attribute_names(SensorKind kind);

/// What was said, or the usual value. The kind must have it.
double attribute(const SensorSpec& sensor, std::string_view name);

/// What the values of a row are called; empty where numbers are said.
std::vector<std::string> words_of(const AttributeRow& row);

/// A word that names no value, with what there is; who read it says where it stood.
class WrongWord : public Error {
  public:
    using Error::Error;
};

/// The value that is called so. Throws WrongWord.
double value_of_word(const AttributeRow& row, const std::string& word);

/// Whether all are of the kind, within their bounds, and said once.
bool are_possible(SensorKind kind, const std::vector<AttributeValue>& attributes);

}  // namespace reprise::world

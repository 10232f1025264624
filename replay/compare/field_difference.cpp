#include "replay/compare/field_difference.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <numbers>

#include <fmt/format.h>

#include "replay/table/reflection.h"
#include "replay/table/value_text.h"

namespace reprise::replay {

namespace {

using flatbuffers::ReadScalar;
using flatbuffers::TypeTable;
using namespace reflection;

std::string scalar_text(const Field& field, Bytes value) {
    switch (field.type) {
        case flatbuffers::ET_BOOL:
            return ReadScalar<std::uint8_t>(value) != 0 ? "true" : "false";
        case flatbuffers::ET_UTYPE:
        case flatbuffers::ET_UCHAR:
            return enumerator(ReadScalar<std::uint8_t>(value), field.ref);
        case flatbuffers::ET_CHAR:
            return enumerator(ReadScalar<std::int8_t>(value), field.ref);
        case flatbuffers::ET_SHORT:
            return enumerator(ReadScalar<std::int16_t>(value), field.ref);
        case flatbuffers::ET_USHORT:
            return enumerator(ReadScalar<std::uint16_t>(value), field.ref);
        case flatbuffers::ET_INT:
            return enumerator(ReadScalar<std::int32_t>(value), field.ref);
        case flatbuffers::ET_UINT:
            return enumerator(ReadScalar<std::uint32_t>(value), field.ref);
        case flatbuffers::ET_LONG:
            return std::to_string(ReadScalar<std::int64_t>(value));
        case flatbuffers::ET_ULONG:
            return std::to_string(ReadScalar<std::uint64_t>(value));
        case flatbuffers::ET_FLOAT:
            return value_text(ReadScalar<float>(value));
        case flatbuffers::ET_DOUBLE:
            return value_text(ReadScalar<double>(value));
        default:
            return "?";
    }
}

std::string distance_of(const Field& field, Bytes expected, Bytes found) {
    if (field.type == flatbuffers::ET_FLOAT)
        return distance_text(ReadScalar<float>(expected), ReadScalar<float>(found));
    if (field.type == flatbuffers::ET_DOUBLE)
        return distance_text(ReadScalar<double>(expected), ReadScalar<double>(found));
    return "";
}

/// After how much a value begins anew, such as a direction; 0: never.
double period_of(std::string_view field) {
    if (field == "yaw" || field == "rotation")
        return 2 * std::numbers::pi;
    return field == "phase" ? 1 : 0;
}

double real_at(const Field& field, Bytes value) {
    return field.type == flatbuffers::ET_FLOAT ? static_cast<double>(ReadScalar<float>(value))
                                               : ReadScalar<double>(value);
}

/// How far two reals are apart: in their unit, or where one is larger than 1 as a share of it.
double apart(const Field& field, double expected, double found) {
    double gap = std::abs(expected - found);
    if (const double period = period_of(field.name); period > 0)
        gap = std::min(gap, std::abs(period - gap));
    return gap / std::max({1.0, std::abs(expected), std::abs(found)});
}

std::uint64_t key_value(const Field& field, const TypeTable& type, Bytes element) {
    const Bytes value = address(type, element, field);
    return field.type == flatbuffers::ET_UINT ? ReadScalar<std::uint32_t>(value)
                                              : ReadScalar<std::uint8_t>(value);
}

/// The ids of an element; the second one is 0 where one is enough.
using Key = std::array<std::uint64_t, 2>;

/// A step down from an object: to a member, or to an element by position or by ids.
struct Step {
    const char* member = nullptr;
    const std::vector<Field>* key = nullptr;
    Key ids{};  ///< ids[0] is the position of an element without any
};

std::string text_of(const std::vector<Step>& path) {
    std::string text;
    for (const Step& step : path) {
        if (step.member != nullptr) {
            text += (text.empty() ? "" : ".") + std::string(step.member);
        } else if (step.key == nullptr) {
            text += fmt::format("[{}]", step.ids[0]);
        } else {
            for (std::size_t part = 0; part < step.key->size(); ++part)
                text += fmt::format(
                    "{}{} {}", part == 0 ? "[" : ", ", (*step.key)[part].name, step.ids[part]);
            text += "]";
        }
    }
    return text;
}

/// Walks two objects side by side. Where they agree it makes no text.
class Walk {
  public:
    std::vector<FieldDifference> result;

    explicit Walk(Tolerance* tolerance) : tolerance_(tolerance) {}

    void field(const TypeTable& type, const Field& field, Bytes expected, Bytes found) {
        path_.push_back({field.name});
        const Bytes left = address(type, expected, field);
        const Bytes right = address(type, found, field);
        if (field.repeating)
            vector(field, elements_of(field, left), elements_of(field, right));
        else if (field.type == flatbuffers::ET_STRING)
            text(left, right);
        else if (left != nullptr && right != nullptr)
            value(field, left, right);
        else if (left != right)
            report(left ? "present" : "absent", right ? "present" : "absent");
        path_.pop_back();
    }

  private:
    void value(const Field& field, Bytes expected, Bytes found) {
        if (field.type == flatbuffers::ET_STRING)
            return text(expected, found);
        if (is_table(field))
            return object(*field.ref, follow(expected), follow(found));
        if (std::memcmp(expected, found, flatbuffers::InlineSize(field.type, field.ref)) == 0)
            return;
        if (field.type == flatbuffers::ET_SEQUENCE)
            return object(*field.ref, expected, found);
        if (tolerated(field, expected, found))
            return;
        report(scalar_text(field, expected), scalar_text(field, found));
        result.back().distance = distance_of(field, expected, found);
    }

    bool tolerated(const Field& field, Bytes expected, Bytes found) {
        if (tolerance_ == nullptr ||
            (field.type != flatbuffers::ET_FLOAT && field.type != flatbuffers::ET_DOUBLE))
            return false;
        const double gap = apart(field, real_at(field, expected), real_at(field, found));
        if (!(gap <= tolerance_->bound))  // nor what is no number
            return false;
        if (gap > tolerance_->largest) {
            tolerance_->largest = gap;
            tolerance_->field = text_of(path_);
            tolerance_->expected = scalar_text(field, expected);
            tolerance_->found = scalar_text(field, found);
        }
        return true;
    }

    void object(const TypeTable& type, Bytes expected, Bytes found) {
        for (std::size_t i = 0; i < type.num_elems; ++i)
            field(type, field_at(type, i), expected, found);
    }

    /// An absent text and an empty one are the same.
    void text(Bytes expected, Bytes found) {
        if (text_at(expected) == text_at(found))
            return;
        const auto [left, right] = text_pair(text_at(expected), text_at(found));
        report(left, right);
    }

    void vector(const Field& field, Elements left, Elements right) {
        const std::vector<Field> key = key_of(field);
        if (key.empty())
            by_position(field, left, right);
        else
            by_key(field, key, left, right);
    }

    void by_position(const Field& field, Elements left, Elements right) {
        for (std::size_t i = 0; i < std::max(left.count, right.count); ++i) {
            path_.push_back({nullptr, nullptr, {i, 0}});
            const Bytes expected = i < left.count ? left.at(i) : nullptr;
            const Bytes found = i < right.count ? right.at(i) : nullptr;
            actor_ = actor_of(field, expected != nullptr ? expected : found);
            if (expected != nullptr && found != nullptr)
                value(field, expected, found);
            else
                report(presence(field, expected), presence(field, found));
            path_.pop_back();
        }
        actor_ = 0;
    }

    /// Both sides are sorted, so this is a merge.
    void by_key(const Field& field, const std::vector<Field>& key, Elements left, Elements right) {
        const auto ids_of = [&](Bytes element) {
            Key ids{};
            for (std::size_t part = 0; part < key.size(); ++part)
                ids[part] = key_value(key[part], *field.ref, element);
            return ids;
        };
        std::size_t i = 0;
        std::size_t j = 0;
        while (i < left.count || j < right.count) {
            const Bytes a = i < left.count ? left.at(i) : nullptr;
            const Bytes b = j < right.count ? right.at(j) : nullptr;
            const bool take_left = b == nullptr || (a != nullptr && ids_of(a) <= ids_of(b));
            const bool take_right = a == nullptr || (b != nullptr && ids_of(b) <= ids_of(a));
            path_.push_back({nullptr, &key, ids_of(take_left ? a : b)});
            actor_ = static_cast<std::uint32_t>(path_.back().ids[0]);
            if (take_left && take_right)
                value(field, a, b);
            else
                report(presence(field, take_left ? a : nullptr),
                       presence(field, take_right ? b : nullptr));
            path_.pop_back();
            i += take_left ? 1 : 0;
            j += take_right ? 1 : 0;
        }
        actor_ = 0;
    }

    /// "absent", "present", or of things that have kinds: "collision".
    static std::string presence(const Field& field, Bytes element) {
        if (element == nullptr)
            return "absent";
        if (field.type != flatbuffers::ET_SEQUENCE)
            return field.type == flatbuffers::ET_STRING ? "present" : scalar_text(field, element);
        const std::vector<Field> fields = fields_of(*field.ref);
        const Field* kind = find_field(fields, "kind");
        if (!is_table(field) || kind == nullptr)
            return "present";
        const Bytes value = address(*field.ref, follow(element), *kind);
        return value == nullptr ? "present" : scalar_text(*kind, value);
    }

    static std::uint32_t actor_of(const Field& field, Bytes element) {
        if (!is_table(field))
            return 0;
        const std::vector<Field> fields = fields_of(*field.ref);
        const Field* actor = find_field(fields, "actor");
        if (actor == nullptr || actor->type != flatbuffers::ET_UINT)
            return 0;
        const Bytes value = address(*field.ref, follow(element), *actor);
        return value == nullptr ? 0 : ReadScalar<std::uint32_t>(value);
    }

    void report(std::string expected, std::string found) {
        result.push_back({text_of(path_), std::move(expected), std::move(found), "", actor_});
    }

    Tolerance* tolerance_;
    std::vector<Step> path_;
    std::uint32_t actor_ = 0;
};

}  // namespace

std::vector<FieldDifference> differences(const flatbuffers::TypeTable& type,
                                         const void* expected,
                                         const void* found,
                                         std::string_view field,
                                         Tolerance* tolerance) {
    Walk walk(tolerance);
    for (const Field& candidate : fields_of(type)) {
        if (candidate.name == field)
            walk.field(type, candidate, static_cast<Bytes>(expected), static_cast<Bytes>(found));
    }
    return std::move(walk.result);
}

std::vector<std::string_view> field_names(const flatbuffers::TypeTable& type) {
    return {type.names, type.names + type.num_elems};
}

}  // namespace reprise::replay

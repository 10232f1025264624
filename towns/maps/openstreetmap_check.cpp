// Must: name the element that would make a town too large to build, before anything is built.
// Assumes: nothing of the file but its size (map_source.cpp).
// Goes: the places of all nodes; then each way that a town shows: its steps, and its tags.
// Keeps: the places, sorted by the nodes' ids.
#include "towns/maps/openstreetmap_check.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <numbers>
#include <optional>
#include <string_view>
#include <vector>

#include <fmt/format.h>
#include <osmium/osm/node.hpp>
#include <osmium/osm/relation.hpp>
#include <osmium/osm/way.hpp>

#include "towns/maps/osm_objects.h"
#include "towns/maps/plain_coordinates.h"
#include "towns/network/network_xml.h"
#include "world/check.h"
#include "world/printable.h"

namespace reprise::towns {

namespace {

using Id = osmium::object_id_type;
using std::string_view;

constexpr double longest_step = 20'000;       // [m] between two nodes of a way
constexpr double widest = 200'000;            // [m] of all roads, as of a town
constexpr std::size_t most_members = 32'000;  // of a way or relation: OpenStreetMap's own is lower
constexpr double earth_radius = 6'371'000;    // [m]

/// A tag that roads have, and the largest number that it can mean.
struct Bound {
    const char* key;
    double largest;
};

constexpr std::array bounds{Bound{"lanes", 64},
                            Bound{"lanes:forward", 64},
                            Bound{"lanes:backward", 64},
                            Bound{"lanes:both_ways", 64},
                            Bound{"width", 200},
                            Bound{"width:lanes", 200},
                            Bound{"layer", 50},
                            Bound{"level", 500},
                            Bound{"maxspeed", 1000}};

struct Place {
    Id id = 0;
    float longitude = 0;  ///< [degrees]; floats are true to 2 m
    float latitude = 0;
};

/// [m]
double distance(const Place& from, const Place& to) {
    constexpr double degree = std::numbers::pi / 180;
    const double latitude = degree * (double{from.latitude} + double{to.latitude}) / 2;
    const double east =
        degree * (double{to.longitude} - double{from.longitude}) * std::cos(latitude);
    const double north = degree * (double{to.latitude} - double{from.latitude});
    return earth_radius * std::hypot(east, north);
}

class MapCheck {
  public:
    MapCheck(const std::filesystem::path& map, const std::string& called)
        : map_(map),
          called_(called) {}

    void run() {
        read_places();
        for_each_object<osmium::Way>(
            map_, osmium::osm_entity_bits::way, [&](const osmium::Way& way) { check(way); });
        if (low_ && distance(*low_, *high_) > widest)
            fail(fmt::format("node {}", farthest_->id),
                 fmt::format("its roads would be {:.0f} km wide; {:.0f} km are built at most",
                             distance(*low_, *high_) / 1000,
                             widest / 1000));
        for_each_object<osmium::Relation>(
            map_, osmium::osm_entity_bits::relation, [&](const osmium::Relation& relation) {
                if (relation.members().size() > most_members)
                    fail(fmt::format("relation {}", relation.id()),
                         fmt::format("has more than {} members", most_members));
            });
    }

  private:
    [[noreturn]] void fail(const std::string& element, const std::string& what) const {
        throw world::Error(fmt::format("{}: {}: {}", called_, element, world::printable(what)));
    }

    void read_places() {
        for_each_object<osmium::Node>(
            map_, osmium::osm_entity_bits::node, [&](const osmium::Node& node) {
                if (!node.location().valid())
                    fail(fmt::format("node {}", node.id()),
                         "its latitude and longitude are no place on the globe");
                places_.push_back({node.id(),
                                   static_cast<float>(node.location().lon_without_check()),
                                   static_cast<float>(node.location().lat_without_check())});
            });
        std::sort(places_.begin(), places_.end(), [](const Place& one, const Place& other) {
            return one.id < other.id;
        });
        if (places_.empty())
            return;
        const auto middle_of = [&](auto member) {
            std::vector<float> all;
            for (const Place& place : places_)
                all.push_back(place.*member);
            const auto middle = all.begin() + static_cast<std::ptrdiff_t>(all.size() / 2);
            std::nth_element(all.begin(), middle, all.end());
            return *middle;
        };
        middle_ = {0, middle_of(&Place::longitude), middle_of(&Place::latitude)};
    }

    const Place* place_of(Id node) const {
        const auto found =
            std::lower_bound(places_.begin(), places_.end(), node, [](const Place& place, Id id) {
                return place.id < id;
            });
        return found != places_.end() && found->id == node ? &*found : nullptr;
    }

    /// Which of two is out of place.
    const Place& farther(const Place& one, const Place& other) const {
        return distance(middle_, one) > distance(middle_, other) ? one : other;
    }

    void check(const osmium::Way& way) {
        const std::string name = fmt::format("way {}", way.id());
        if (way.nodes().size() > most_members)
            fail(name, fmt::format("has more than {} nodes", most_members));
        const bool is_road = way.tags().has_key("highway");
        // Borders and power lines take long steps, and are not shown.
        if (!is_road && !way.tags().empty() && !way.tags().has_key("building") &&
            !way.tags().has_key("landuse") && !way.tags().has_key("natural") &&
            !way.tags().has_key("leisure") && !way.tags().has_key("amenity"))
            return;
        for (const Bound& bound : bounds)
            if (const char* value = way.tags().get_value_by_key(bound.key); is_road && value)
                check(name, bound, value);
        const Place* last = nullptr;
        for (const osmium::NodeRef& node : way.nodes()) {
            const Place* place = place_of(node.ref());
            if (place == nullptr)
                continue;
            if (last != nullptr && distance(*last, *place) > longest_step)
                fail(name,
                     fmt::format("its nodes {} and {} lie {:.0f} km apart, {:.0f} km are possible; "
                                 "is node {} in its place?",
                                 last->id,
                                 place->id,
                                 distance(*last, *place) / 1000,
                                 longest_step / 1000,
                                 farther(*last, *place).id));
            last = place;
            if (is_road)
                widen(*place);
        }
    }

    /// `value` may be a list, and may have a unit behind it.
    void check(const std::string& way, const Bound& bound, string_view value) const {
        constexpr string_view digits = "0123456789.";
        constexpr std::size_t longest = 1000;
        if (value.size() > longest)
            fail(way, fmt::format("its tag {} is longer than {} bytes", bound.key, longest));
        for (std::size_t at = value.find_first_of(digits); at != string_view::npos;) {
            double there = 0;
            // With an exponent, where there is one: netconvert understands 1e9.
            const auto [behind, error] =
                std::from_chars(value.data() + at, value.data() + value.size(), there);
            const std::size_t end =
                std::max(static_cast<std::size_t>(behind - value.data()), at + 1);
            if (there > bound.largest || error == std::errc::result_out_of_range)
                fail(way,
                     fmt::format("{}={}: {:.0f} at most are possible",
                                 bound.key,
                                 value.substr(0, 40),
                                 bound.largest));
            at = value.find_first_of(digits, end);
        }
    }

    void widen(const Place& place) {
        if (!low_)
            low_ = high_ = place;
        low_->longitude = std::min(low_->longitude, place.longitude);
        low_->latitude = std::min(low_->latitude, place.latitude);
        high_->longitude = std::max(high_->longitude, place.longitude);
        high_->latitude = std::max(high_->latitude, place.latitude);
        if (distance(middle_, place) > distance(middle_, farthest_.value_or(middle_)))
            farthest_ = place;
    }

    std::filesystem::path map_;
    const std::string& called_;
    std::vector<Place> places_;
    Place middle_;                     ///< the median of all
    std::optional<Place> low_, high_;  ///< corners of all roads
    std::optional<Place> farthest_;
};

}  // namespace

void check_openstreetmap(const std::filesystem::path& map, const std::string& called) {
    try {
        check_coordinates(map, called);
        MapCheck(map, called).run();
    } catch (const world::Error&) {
        throw;
    } catch (const std::exception& error) {
        throw world::Error(fmt::format(
            "{}: is not as OpenStreetMap writes it: {}", called, world::printable(error.what())));
    }
}

}  // namespace reprise::towns

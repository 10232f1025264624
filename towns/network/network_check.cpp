// Must: refuse, with file, line and element, what SUMO 1.15 stops or crashes on; take every network
//   that a netconvert wrote, of whatever version.
// Assumes: lanes whose numbers were checked (network.cpp).
// Goes: names of all elements first; then each element, and what it names.
// Keeps: the names, for one call.
#include "towns/network/network_check.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <tuple>
#include <unordered_map>
#include <vector>

#include <fmt/format.h>
#include <pugixml.hpp>

#include "towns/network/network_xml.h"
#include "world/check.h"
#include "world/printable.h"
#include "world/words.h"

namespace reprise::towns {

namespace {

using pugi::xml_node;
using std::string_view;

constexpr std::array functions{"normal", "internal", "connector", "crossing", "walkingarea"};
constexpr string_view signal_states = "rRyYgGuoOsS";
constexpr double longest_phase = 1e6;  // [s]

string_view text(xml_node node, const char* name) {
    return node.attribute(name).value();
}

/// A whole number from 0; nothing where there is none.
std::optional<std::size_t> count_in(xml_node node, const char* name) {
    const string_view written = text(node, name);
    const bool digits = !written.empty() && written.size() < 7 &&
                        written.find_first_not_of("0123456789") == string_view::npos;
    return digits ? std::optional(static_cast<std::size_t>(number(written, 0))) : std::nullopt;
}

class NetworkCheck {
  public:
    NetworkCheck(const std::filesystem::path& path, string_view xml, xml_node net)
        : path_(path),
          xml_(xml),
          net_(net) {}

    void run() {
        read_junctions();
        read_edges();
        read_lights();
        for (const xml_node connection : net_.children("connection"))
            check_connection(connection);
        check_paths();
        for (const xml_node junction : net_.children("junction"))
            check_junction(junction);
        check_inner_lanes();
    }

  private:
    struct Edge {
        string_view function;
        string_view junction;  ///< where it ends, or lies in
        std::size_t lanes = 0;
    };

    struct Link {
        xml_node xml;
        const Edge* from;
        const Edge* to;
    };

    template <typename... Values>
    [[noreturn]] void fail(xml_node node,
                           fmt::format_string<const Values&...> what,
                           const Values&... values) const {
        std::string name = fmt::format("<{}", node.name());
        for (const char* key : {"id", "index", "from", "fromLane", "to", "toLane"})
            if (const string_view value = text(node, key); !value.empty())
                name += fmt::format(" {}=\"{}\"", key, world::printable(value.substr(0, 60)));
        throw world::Error(fmt::format("{}:{}: {}>: {}",
                                       path_.string(),
                                       line_of(xml_, static_cast<std::size_t>(node.offset_debug())),
                                       name,
                                       world::printable(fmt::format(what, values...))));
    }

    /// Its name, which no other of its kind has.
    template <typename Names>
    string_view own_name(xml_node node, const Names& taken) const {
        const string_view id = text(node, "id");
        if (id.empty())
            fail(node, "has no id");
        if (taken.count(id) > 0)
            fail(node, "there is another one of that id");
        return id;
    }

    void read_junctions() {
        for (const xml_node junction : net_.children("junction")) {
            const string_view id = own_name(junction, junctions_);
            if (text(junction, "type").empty())
                fail(junction, "has no type");
            for (const char* axis : {"x", "y"})
                if (number(text(junction, axis), farthest + 1) > farthest)
                    fail(junction, "{}=\"{}\" is not a number", axis, text(junction, axis));
            junctions_[id] = text(junction, "type");
        }
    }

    void read_edges() {
        for (const xml_node edge : net_.children("edge")) {
            const string_view id = own_name(edge, edges_);
            Edge& known = edges_[id];
            known.function = text(edge, "function").empty() ? "normal" : text(edge, "function");
            if (std::find(functions.begin(), functions.end(), known.function) == functions.end())
                fail(edge, "SUMO knows no function '{}'", known.function);
            const bool inside = known.function != "normal" && known.function != "connector";
            if (inside != (id.front() == ':'))
                fail(edge, "only edges within junctions have a ':' before their id");
            known.junction = inside ? id.substr(1, id.rfind('_') - 1) : text(edge, "to");
            if (!inside)
                for (const char* end : {"from", "to"})
                    if (junctions_.count(text(edge, end)) == 0)
                        fail(edge, "{}=\"{}\": there is no such junction", end, text(edge, end));
            for (const xml_node lane : edge.children("lane"))
                read_lane(lane, id, known);
            if (known.lanes == 0)
                fail(edge, "has no <lane>");
        }
    }

    void read_lane(xml_node lane, string_view edge, Edge& known) {
        if (count_in(lane, "index") != known.lanes)
            fail(lane, "expected index=\"{}\": lanes are numbered from 0", known.lanes);
        const std::string expected = fmt::format("{}_{}", edge, known.lanes);
        if (text(lane, "id") != expected)
            fail(lane, "expected id=\"{}\"", expected);
        ++known.lanes;
        lanes_.insert(text(lane, "id"));
    }

    void read_lights() {
        std::set<std::pair<string_view, string_view>> programs;
        for (const xml_node light : net_.children("tlLogic")) {
            const string_view id = text(light, "id");
            if (id.empty() || text(light, "programID").empty())
                fail(light, "has no {}", id.empty() ? "id" : "programID");
            if (!programs.emplace(id, text(light, "programID")).second)
                fail(light, "there is another program '{}' of it", text(light, "programID"));
            const std::size_t states = states_of(light);
            const auto place = states_.try_emplace(id, states).first;
            place->second = std::min(place->second, states);
        }
    }

    /// How many links its phases have a state for.
    std::size_t states_of(xml_node light) const {
        std::size_t states = 0;
        for (const xml_node phase : light.children("phase")) {
            const double duration = number(text(phase, "duration"), 0);
            if (!(duration > 0 && duration < longest_phase))
                fail(phase,
                     "of the light '{}': duration=\"{}\" is not a number of seconds above 0",
                     text(light, "id"),
                     text(phase, "duration"));
            const string_view state = text(phase, "state");
            if (state.empty() || state.find_first_not_of(signal_states) != string_view::npos)
                fail(phase,
                     "of the light '{}': state=\"{}\": one of {} was expected for each link",
                     text(light, "id"),
                     state,
                     signal_states);
            if (states != 0 && state.size() != states)
                fail(phase,
                     "of the light '{}': has states for {} links, the phases before for {}",
                     text(light, "id"),
                     state.size(),
                     states);
            states = state.size();
        }
        if (states == 0 && text(light, "type") != "off" && text(light, "type") != "railSignal")
            fail(light, "has no <phase>");
        return states;
    }

    /// The lane that a connection names, as "edge_index".
    std::pair<const Edge*, std::string> end_of(xml_node connection,
                                               const char* edge,
                                               const char* lane) const {
        const auto found = edges_.find(text(connection, edge));
        if (found == edges_.end())
            fail(connection, "{}=\"{}\": there is no such edge", edge, text(connection, edge));
        const auto index = count_in(connection, lane);
        if (!index || *index >= found->second.lanes)
            fail(connection,
                 "{}=\"{}\": the edge '{}' has {} lanes",
                 lane,
                 text(connection, lane),
                 found->first,
                 found->second.lanes);
        return {&found->second, fmt::format("{}_{}", found->first, *index)};
    }

    void check_connection(xml_node connection) {
        const auto [from, source] = end_of(connection, "from", "fromLane");
        const auto [to, target] = end_of(connection, "to", "toLane");
        for (const char* name : {"dir", "state"})
            if (text(connection, name).size() != 1 && text(connection, name) != "invalid")
                fail(
                    connection, "{}=\"{}\": one letter was expected", name, text(connection, name));
        if (!ends_.emplace(source, target).second)
            fail(connection, "there is another one from this lane to that");
        links_[source].push_back({connection, from, to});
        if (!text(connection, "via").empty() && lanes_.count(text(connection, "via")) == 0)
            fail(connection, "via=\"{}\": there is no such lane", text(connection, "via"));
        vias_.insert(text(connection, "via"));
        if (text(connection, "tl").empty())
            return;
        const auto light = states_.find(text(connection, "tl"));
        if (light == states_.end()) {
            const auto junction = junctions_.find(text(connection, "tl"));
            if (junction != junctions_.end() && junction->second.starts_with("rail_"))
                return;  // its program is made by SUMO
            fail(connection, "tl=\"{}\": there is no such <tlLogic>", text(connection, "tl"));
        }
        const auto index = count_in(connection, "linkIndex");
        if (!index || (*index >= light->second && light->second > 0))
            fail(connection,
                 "linkIndex=\"{}\": the light '{}' has states for {} links",
                 text(connection, "linkIndex"),
                 light->first,
                 light->second);
    }

    /// Who goes through a junction comes out where the connection says.
    void check_paths() const {
        for (const auto& [source, links] : links_)
            for (const Link& link : links) {
                const string_view via = text(link.xml, "via");
                if (via.empty())
                    continue;
                const string_view around = via.substr(0, via.rfind('_'));
                if (edges_.at(around).junction != link.from->junction)
                    fail(link.xml, "via=\"{}\" lies in another junction", via);
                const auto on = links_.find(std::string(via));
                const bool leads =
                    on != links_.end() &&
                    std::any_of(on->second.begin(), on->second.end(), [&](const Link& next) {
                        return next.to == link.to &&
                               text(next.xml, "toLane") == text(link.xml, "toLane");
                    });
                if (!leads)
                    fail(link.xml, "via=\"{}\": no connection leads on from there", via);
            }
    }

    void check_inner_lanes() const {
        for (const xml_node edge : net_.children("edge"))
            for (const xml_node lane : edge.children("lane"))
                if (text(edge, "function") == "internal") {
                    if (links_.count(text(lane, "id")) == 0)
                        fail(lane, "no connection leads on from it");
                    if (vias_.count(text(lane, "id")) == 0)
                        fail(lane, "no connection has it as its via");
                }
    }

    void check_junction(xml_node junction) const {
        for (const char* name : {"incLanes", "intLanes"})
            for (const string_view lane : world::words(text(junction, name)))
                if (lanes_.count(lane) == 0)
                    fail(junction, "{}: there is no lane '{}'", name, lane);
        if (text(junction, "type") == "internal")
            return;
        const bool has_inside = !world::words(text(junction, "intLanes")).empty();
        std::size_t expected = 0;
        for (const string_view lane : world::words(text(junction, "incLanes"))) {
            const auto found = links_.find(lane);
            if (found == links_.end())
                continue;
            for (const Link& link : found->second) {
                const bool onto_area = link.to->function == "walkingarea";
                const bool off_area = link.from->function == "walkingarea";
                expected += !onto_area && (!off_area || link.to->function == "crossing") ? 1 : 0;
                if (has_inside && !onto_area && !off_area && text(link.xml, "via").empty() &&
                    link.from->function != "crossing")
                    fail(link.xml, "has no via, a lane through the junction");
            }
        }
        check_requests(junction, expected);
    }

    /// Who gives way to whom: a row for each link through the junction, in each a bit for each.
    void check_requests(xml_node junction, std::size_t expected) const {
        std::size_t rows = 0;
        for (const xml_node request : junction.children("request")) {
            if (count_in(request, "index") != rows)
                fail(request,
                     "of the junction '{}': expected index=\"{}\"",
                     text(junction, "id"),
                     rows);
            for (const char* name : {"response", "foes"})
                if (text(request, name).size() != expected ||
                    text(request, name).find_first_not_of("01") != string_view::npos)
                    fail(request,
                         "of the junction '{}': {}=\"{}\": 0 or 1 was expected for each of its {} "
                         "links",
                         text(junction, "id"),
                         name,
                         text(request, name),
                         expected);
            const string_view cont = text(request, "cont");
            const bool is_given = !request.attribute("cont").empty();
            if (is_given && cont != "0" && cont != "1" && cont != "true" && cont != "false")
                fail(request,
                     "of the junction '{}': cont=\"{}\": 0 or 1 was expected",
                     text(junction, "id"),
                     cont);
            ++rows;
        }
        if (rows != 0 && rows != expected)
            fail(junction, "has {} links, but {} <request>", expected, rows);
    }

    static constexpr double farthest = 1e8;  // [m]

    const std::filesystem::path& path_;
    string_view xml_;
    xml_node net_;
    std::map<string_view, string_view> junctions_;  ///< their types
    std::map<string_view, Edge> edges_;
    std::set<string_view> lanes_;
    std::set<string_view> vias_;                 ///< lanes that connections lead through
    std::map<string_view, std::size_t> states_;  ///< by light: of its program with the fewest
    std::set<std::pair<std::string, std::string>> ends_;
    std::map<std::string, std::vector<Link>, std::less<>> links_;  ///< by the lane they begin at
};

}  // namespace

void check_network(const std::filesystem::path& path, string_view xml, xml_node net) {
    NetworkCheck(path, xml, net).run();
}

}  // namespace reprise::towns

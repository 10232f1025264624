#include "traffic/roads/right_of_way.h"

#include <algorithm>
#include <map>
#include <string>
#include <string_view>
#include <utility>

#include <libsumo/libsumo.h>

#include "traffic/roads/car_network.h"

namespace reprise::traffic {

using world::none;

RightOfWay::RightOfWay(const world::TownT& town, Firsts firsts, std::vector<bool> crossed)
    : firsts_(std::move(firsts)),
      crossed_(std::move(crossed)),
      ways_(town.lanes.size()) {
    firsts_.resize(town.lanes.size());
    crossed_.resize(town.lanes.size(), false);
    for (std::uint32_t from = 0; from < town.lanes.size(); ++from) {
        if (town.lanes[from].kind == world::LaneKind::internal)
            continue;
        for (const world::Link& link : town.lanes[from].links)
            for (std::uint32_t via = link.via();
                 via != none && town.lanes[via].kind == world::LaneKind::internal &&
                 ways_[via].from == none;) {
                ways_[via] = {from, link.via()};
                const auto& links = town.lanes[via].links;
                via = links.empty() ? none : links.front().via();
            }
    }
}

bool RightOfWay::lets_all_of(const Way& way, std::uint32_t from) const {
    return std::binary_search(firsts_[way.first].begin(), firsts_[way.first].end(), from);
}

bool RightOfWay::lets_go(std::uint32_t lane, std::uint32_t other) const {
    const Way& one = ways_[lane];
    const Way& its = ways_[other];
    return one.from != none && its.from != none && lets_all_of(one, its.from) &&
           !lets_all_of(its, one.from);
}

RightOfWay right_of_way_in_sumo(const world::TownT& town) {
    std::map<std::string_view, std::uint32_t> by_name;
    for (std::uint32_t i = 0; i < town.lanes.size(); ++i)
        by_name.emplace(town.lanes[i].name, i);
    const auto is_on_wheels = [&](const std::string& name) {
        const auto found = by_name.find(name);
        return found != by_name.end() && world::is_for_cars(town.lanes[found->second]);
    };
    const std::vector<bool> is_known = lanes_in_sumo(town);
    std::vector<bool> crossed(town.lanes.size(), false);
    RightOfWay::Firsts firsts(town.lanes.size());
    for (std::uint32_t i = 0; i < town.lanes.size(); ++i) {
        const world::LaneT& lane = town.lanes[i];
        if (!world::is_for_cars(lane) || !is_known[i])
            continue;
        if (lane.kind == world::LaneKind::internal) {
            const auto foes = libsumo::Lane::getInternalFoes(lane.name);
            crossed[i] = std::any_of(foes.begin(), foes.end(), is_on_wheels);
            continue;
        }
        for (const world::Link& link : lane.links) {
            if (link.via() == none || link.to() == none || !is_known[link.via()])
                continue;
            auto& before_us = firsts[link.via()];
            for (const std::string& foe :
                 libsumo::Lane::getFoes(lane.name, town.lanes[link.to()].name))
                if (const auto found = by_name.find(foe); found != by_name.end())
                    before_us.push_back(found->second);
            std::sort(before_us.begin(), before_us.end());
        }
    }
    return {town, std::move(firsts), std::move(crossed)};
}

}  // namespace reprise::traffic

#include "world/lanes/road_place.h"

#include <algorithm>
#include <charconv>
#include <set>

#include <fmt/format.h>

#include "world/check.h"

namespace reprise::world {

namespace {

/// The next word, up to one of these letters, which is taken as well.
std::string_view cut(std::string_view& text, char separator) {
    const std::size_t end = std::min(text.find(separator), text.size());
    const std::string_view word = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    return word;
}

template <typename Number>
bool read(std::string_view text, Number& number) {
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    return error == std::errc() && end == text.data() + text.size();
}

std::optional<RoadPiece> read_piece(std::string_view text) {
    RoadPiece piece;
    piece.road = cut(text, ' ');
    if (piece.road.empty() || !read(cut(text, ' '), piece.lane))
        return std::nullopt;
    while (!text.empty()) {
        std::string_view word = cut(text, ' ');
        RoadPiece::Knot knot;
        if (!read(cut(word, ':'), knot.s) || !read(word, knot.road_s) ||
            (!piece.knots.empty() && knot.s < piece.knots.back().s))
            return std::nullopt;
        piece.knots.push_back(knot);
    }
    return piece.knots.size() < 2 ? std::nullopt : std::optional(piece);
}

double between(double at, double from, double to, double low, double high) {
    return to == from ? low : low + (at - from) / (to - from) * (high - low);
}

/// Our s of a road's, if the piece has it.
std::optional<double> own_s(const RoadPiece& piece, double road_s) {
    constexpr double slack = 0.01;  // [m] as knots are rounded
    for (std::size_t i = 0; i + 1 < piece.knots.size(); ++i) {
        const RoadPiece::Knot& from = piece.knots[i];
        const RoadPiece::Knot& to = piece.knots[i + 1];
        const auto [low, high] = std::minmax(from.road_s, to.road_s);
        if (road_s >= low - slack && road_s <= high + slack)
            return between(std::clamp(road_s, low, high), from.road_s, to.road_s, from.s, to.s);
    }
    return std::nullopt;
}

/// Are its pieces what two numbers say?
bool is_plain(const std::vector<RoadPiece>& pieces, const LaneT& lane) {
    constexpr double slack = 0.02;  // [m]
    return pieces.size() == 1 && pieces.front().knots.size() == 2 &&
           pieces.front().knots.front().s < slack &&
           pieces.front().knots.back().s > lane.length - slack;
}

}  // namespace

std::vector<RoadPiece> read_road_pieces(std::string_view text) {
    std::vector<RoadPiece> pieces;
    while (!text.empty())
        if (auto piece = read_piece(cut(text, ';')))
            pieces.push_back(std::move(*piece));
    return pieces;
}

std::string road_pieces_text(const std::vector<RoadPiece>& pieces) {
    std::string text;
    for (const RoadPiece& piece : pieces) {
        text += fmt::format("{}{} {}", text.empty() ? "" : ";", piece.road, piece.lane);
        for (const RoadPiece::Knot& knot : piece.knots)
            text += fmt::format(" {:.2f}:{:.2f}", knot.s, knot.road_s);
    }
    return text;
}

void set_road_pieces(LaneT& lane, const std::vector<RoadPiece>& pieces) {
    if (pieces.empty())
        return;
    std::string roads;
    for (const RoadPiece& piece : pieces)
        roads += (roads.empty() ? "" : " ") + piece.road;
    lane.road = is_plain(pieces, lane) ? roads : roads + "|" + road_pieces_text(pieces);
    lane.road_lane = static_cast<std::int16_t>(pieces.front().lane);
    lane.road_s = pieces.front().knots.front().road_s;
    lane.road_s_end = pieces.back().knots.back().road_s;
}

std::vector<RoadPiece> road_pieces(const LaneT& lane) {
    if (lane.road.empty())
        return {};
    if (const std::size_t bar = lane.road.find('|'); bar != std::string::npos)
        return read_road_pieces(std::string_view(lane.road).substr(bar + 1));
    return {{lane.road, lane.road_lane, {{0, lane.road_s}, {lane.length, lane.road_s_end}}}};
}

std::optional<RoadPlace> road_place(const LaneT& lane, double s) {
    const std::vector<RoadPiece> pieces = road_pieces(lane);
    const RoadPiece* piece = nullptr;
    for (const RoadPiece& next : pieces)
        if (piece == nullptr || next.knots.front().s <= s)
            piece = &next;
    if (piece == nullptr)
        return std::nullopt;
    s = std::clamp(s, piece->knots.front().s, piece->knots.back().s);
    for (std::size_t i = 0; i + 1 < piece->knots.size(); ++i) {
        const RoadPiece::Knot& from = piece->knots[i];
        const RoadPiece::Knot& to = piece->knots[i + 1];
        if (s <= to.s)
            return RoadPlace{
                piece->road, piece->lane, between(s, from.s, to.s, from.road_s, to.road_s)};
    }
    return RoadPlace{piece->road, piece->lane, piece->knots.back().road_s};
}

std::optional<FoundPlace> find_road_place(const TownT& town, const RoadPlace& place) {
    std::optional<FoundPlace> inside;
    for (std::uint32_t index = 0; index < town.lanes.size(); ++index) {
        const LaneT& lane = town.lanes[index];
        if (lane.road.find(place.road) == std::string::npos)
            continue;
        for (const RoadPiece& piece : road_pieces(lane)) {
            if (piece.road != place.road || piece.lane != place.lane)
                continue;
            const auto s = own_s(piece, place.s);
            if (s && lane.kind != LaneKind::internal)
                return FoundPlace{index, *s};
            if (s && !inside)
                inside = FoundPlace{index, *s};
        }
    }
    return inside;
}

FoundPlace road_place_named(const TownT& town, const RoadPlace& place) {
    if (const auto found = find_road_place(town, place))
        return *found;
    std::set<std::string> roads;
    std::set<int> lanes;
    std::string parts;
    for (const LaneT& lane : town.lanes)
        for (const RoadPiece& piece : road_pieces(lane)) {
            roads.insert(piece.road);
            if (piece.road != place.road)
                continue;
            lanes.insert(piece.lane);
            const auto [low, high] =
                std::minmax(piece.knots.front().road_s, piece.knots.back().road_s);
            if (piece.lane == place.lane)
                parts += fmt::format("{}{:.2f} to {:.2f}", parts.empty() ? "" : ", ", low, high);
        }
    if (roads.empty())
        throw Error(fmt::format("{} was no OpenDRIVE map: it has no roads by number", town.name));
    if (lanes.empty())
        throw Error(fmt::format("no road '{}' in {}{}",
                                place.road,
                                town.name,
                                did_you_mean(place.road, {roads.begin(), roads.end()})));
    if (!parts.empty())
        throw Error(fmt::format(
            "no lane at s = {:.2f} of road '{}', lane {}: there is one from {} m; the rest lies in "
            "junctions",
            place.s,
            place.road,
            place.lane,
            parts));
    std::string known;
    for (const int lane : lanes)
        known += fmt::format("{}{}", known.empty() ? "" : ", ", lane);
    throw Error(fmt::format(
        "road '{}' of {} has no lane {}; there are {}", place.road, town.name, place.lane, known));
}

}  // namespace reprise::world

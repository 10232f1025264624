// Must: give every link of a program green as before or more often, and nobody who meets at
//   once but those who had; end every green of a car in yellow.
// Assumes: phases of netconvert: a green, its end for walkers, yellow.
// Goes: the greens are sets of links; two of them become one where all of their cars may drive at
//   once and every crossing still has a green somewhere. Then all who may join in.
// Keeps: nothing.
#include "towns/import/united_greens.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "towns/network/network_xml.h"

namespace reprise::towns {

namespace {

constexpr double cycle = 90;      ///< [s] as netconvert's own
constexpr int walkers_clear = 5;  ///< [s] of a crossing, while cars still have green
constexpr int yellow = 3;         ///< [s]

/// Does each link have green?
using Greens = std::vector<bool>;

bool is_go(char state) {
    return state == 'G' || state == 'g';
}

/// One program: its links by their numbers, and who may drive together.
class Program {
  public:
    Program(pugi::xml_node program, pugi::xml_node net, const JunctionLinks& links)
        : name_(program.attribute("id").value()) {
        for (const pugi::xml_node phase : program.children("phase")) {
            const std::string state = phase.attribute("state").value();
            size_ = std::max(size_, state.size());
            if (is_green(phase))
                states_.push_back(state);
        }
        for (std::string& state : states_)
            state.resize(size_, 'r');
        meets_.assign(size_, Greens(size_, false));
        walks_.assign(size_, false);
        seen_.assign(size_, false);
        for (const pugi::xml_node junction : net.children("junction"))
            take(junction, links);
        for (std::size_t link = 0; link < size_; ++link)
            if (!seen_[link])
                for (std::size_t other = 0; other < size_; ++other)
                    meets_[link][other] = meets_[other][link] = true;
        for (const std::string& state : states_)
            allow_together(state);
    }

    std::vector<Greens> greens() const {
        std::vector<Greens> all;
        for (const std::string& state : states_) {
            Greens set(size_, false);
            for (std::size_t i = 0; i < state.size(); ++i)
                set[i] = is_go(state[i]) && !walks_[i];
            all.push_back(std::move(set));
        }
        return all;
    }

    std::size_t size() const { return size_; }

    bool walks(std::size_t link) const { return walks_[link]; }

    bool may_join(std::size_t link, const Greens& set) const {
        for (std::size_t i = 0; i < size_; ++i)
            if (set[i] && meets_[link][i])
                return false;
        return true;
    }

    bool may_be_one(const Greens& one, const Greens& other) const {
        for (std::size_t i = 0; i < size_; ++i)
            if (one[i] && !may_join(i, other))
                return false;
        return true;
    }

    /// Is there one of these greens for each crossing that had one?
    bool leaves_every_crossing_a_green(const std::vector<Greens>& sets) const {
        for (std::size_t i = 0; i < size_; ++i)
            if (walks_[i] && had_green(i) &&
                std::none_of(
                    sets.begin(), sets.end(), [&](const Greens& set) { return may_join(i, set); }))
                return false;
        return true;
    }

    bool had_green(std::size_t link) const {
        return std::any_of(states_.begin(), states_.end(), [&](const std::string& state) {
            return is_go(state[link]);
        });
    }

    /// Those who only had green beside others that they meet give way.
    char letter(std::size_t link) const {
        return std::any_of(states_.begin(),
                           states_.end(),
                           [&](const std::string& state) { return state[link] == 'g'; })
                   ? 'g'
                   : 'G';
    }

  private:
    void take(pugi::xml_node junction, const JunctionLinks& links) {
        struct Here {
            std::size_t row = 0;
            std::size_t link = 0;
        };

        std::vector<Here> here;
        for (const JunctionLink& link : links.through_and_over(junction)) {
            const std::size_t number = link.xml.attribute("linkIndex").as_uint(0);
            if (name_ != link.xml.attribute("tl").value() || number >= size_)
                continue;
            here.push_back({link.index, number});
            seen_[number] = true;
            walks_[number] = walks_[number] || link.walks;
        }
        const JunctionRows rows(junction);
        for (const Here& one : here)
            for (const Here& other : here)
                if (one.link != other.link && rows.are_foes(one.row, other.row))
                    meets_[one.link][other.link] = meets_[other.link][one.link] = true;
    }

    void allow_together(const std::string& state) {
        for (std::size_t i = 0; i < state.size(); ++i)
            for (std::size_t k = 0; k < state.size(); ++k)
                if (is_go(state[i]) && is_go(state[k]))
                    meets_[i][k] = false;
    }

    std::string name_;
    std::size_t size_ = 0;
    std::vector<std::string> states_;  ///< of the greens
    std::vector<Greens> meets_;        ///< [link][link]
    std::vector<bool> walks_;          ///< [link]
    std::vector<bool> seen_;  ///< [link] at a junction; of others nobody knows whom they meet
};

void unite(std::vector<Greens>& sets, const Program& program) {
    for (std::size_t i = 0; i < sets.size(); ++i)
        for (std::size_t k = i + 1; k < sets.size();) {
            std::vector<Greens> united = sets;
            for (std::size_t link = 0; link < program.size(); ++link)
                united[i][link] = sets[i][link] || sets[k][link];
            united.erase(united.begin() + static_cast<std::ptrdiff_t>(k));
            if (program.may_be_one(sets[i], sets[k]) &&
                program.leaves_every_crossing_a_green(united))
                sets = std::move(united);
            else
                ++k;
        }
}

/// Cars that still may join in, as long as every crossing keeps its green; then crossings.
void fill(std::vector<Greens>& sets, const Program& program) {
    for (const bool walks : {false, true})
        for (Greens& set : sets)
            for (std::size_t link = 0; link < program.size(); ++link) {
                if (set[link] || program.walks(link) != walks || !program.had_green(link) ||
                    !program.may_join(link, set))
                    continue;
                set[link] = true;
                if (!walks && !program.leaves_every_crossing_a_green(sets))
                    set[link] = false;
            }
}

void write(pugi::xml_node program, const std::vector<Greens>& sets, const Program& known) {
    while (program.remove_child("phase")) {
    }
    const auto add = [&](double duration, const std::string& state) {
        pugi::xml_node phase = program.append_child("phase");
        phase.append_attribute("duration").set_value(fmt::format("{}", duration).c_str());
        phase.append_attribute("state").set_value(state.c_str());
    };
    const auto count = static_cast<double>(sets.size());
    const double green =
        std::max(shortest_green, std::floor(cycle / count) - walkers_clear - yellow);
    for (std::size_t i = 0; i < sets.size(); ++i) {
        const Greens& next = sets[(i + 1) % sets.size()];
        std::string go(known.size(), 'r');
        for (std::size_t link = 0; link < go.size(); ++link)
            if (sets[i][link])
                go[link] = known.letter(link);
        add(green, go);
        for (std::size_t link = 0; link < go.size(); ++link)
            if (sets[i][link] && known.walks(link) && !next[link])
                go[link] = 'r';
        add(walkers_clear, go);
        for (std::size_t link = 0; link < go.size(); ++link)
            if (sets[i][link] && !known.walks(link) && !next[link])
                go[link] = 'y';
        add(yellow, go);
    }
}

}  // namespace

bool is_green(pugi::xml_node phase) {
    const std::string_view state = phase.attribute("state").value();
    return number(phase.attribute("duration").value(), 0) >= shortest_green &&
           state.find('y') == std::string_view::npos &&
           std::any_of(state.begin(), state.end(), is_go);
}

bool unite_greens(pugi::xml_node program, pugi::xml_node net, const JunctionLinks& links) {
    const Program known(program, net, links);
    std::vector<Greens> sets = known.greens();
    const std::size_t before = sets.size();
    unite(sets, known);
    if (sets.size() == before)
        return false;
    fill(sets, known);
    write(program, sets, known);
    return true;
}

}  // namespace reprise::towns

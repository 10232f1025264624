// Private to the room: elements of the document are handed around.
#pragma once

#include <map>
#include <set>
#include <string>
#include <vector>

#include <Eigen/Core>
#include <pugixml.hpp>

namespace reprise::towns {

using DrawnLine = std::vector<Eigen::Vector3d>;

double drawn_metres(const DrawnLine& line);

/// In plan, from the first point to the first that is elsewhere; zero: there is none.
Eigen::Vector2d first_direction(const DrawnLine& line);

DrawnLine reversed(DrawnLine line);

/// The lanes of a network by their ids, and the ways through junctions that join them. What is
/// drawn anew is written into the network, which must outlive this.
class DrawnWays {
  public:
    struct Lane {
        pugi::xml_node node;
        DrawnLine line;
        std::set<std::string> before;  ///< ids of ways that lead onto it
        std::set<std::string> behind;  ///< and off it
    };

    /// One that joins two roads; of two lanes where one waits in the middle of the junction.
    struct Way {
        std::string from;
        std::string via;   ///< its first lane
        std::string last;  ///< its last one, mostly the same
        std::string to;
        bool turns_round = false;
    };

    explicit DrawnWays(pugi::xml_node net);

    Lane& at(const std::string& id) { return lanes_.at(id); }

    const std::vector<Way>& ways() const { return ways_; }

    /// The road of the lane is as long as that is drawn, as SUMO has one length for all its lanes.
    void redraw(const std::string& id, const DrawnLine& line);

  private:
    void take(pugi::xml_node connection);

    std::map<std::string, Lane> lanes_;
    std::vector<Way> ways_;
};

}  // namespace reprise::towns

#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "world/town_generated.h"

namespace reprise::towns {

/// What a road network does not hold about its town. It lies beside NAME.net.xml as NAME.place.xml:
/// written by `town import` from what the source knew (signs, signal poses, footprints), or by hand
/// for a town of our own (districts, parks, squares).
/// Coordinates are the network's. [m], yaw in degrees counter-clockwise from east.
///
/// A shape is "x,y[,z] x,y[,z] ..."; an element's z is added to each of its points. An attribute
/// that is left out is 0 or empty.
///
///     <place>
///       <head program="J3" links="0 1" x="1" y="2" z="0" yaw="90" height="5.2" arm="0"/>
///       <sign kind="speed_limit" value="30" x="1" y="2" z="0" yaw="90" height="2.4"/>
///       <plot kind="park" shape="0,0 50,0 50,40 0,40"/>
///       <building shape="0,0 12,0 12,9 0,9" z="0" height="9" model="brick_house"/>
///       <district style="old" shape="..."/>
///       <keep_clear shape="..."/>
///     </place>
struct Place {
    /// A lamp housing whose pose is known: for links `links` of program `program`.
    struct Head {
        std::string program;
        std::vector<std::uint32_t> links;
        world::Vec3 foot;
        double yaw = 0;     ///< [rad] driving direction of those who look at it
        double height = 0;  ///< [m] of the housing's middle
        double arm = 0;     ///< [m] to the left of yaw
    };

    /// Which buildings stand in a region: "village", "old", "brick", "modern", "centre".
    struct District {
        std::string style;
        std::vector<world::Vec3> outline;  ///< empty: everywhere else
    };

    std::vector<Head> heads;
    std::vector<world::Prop> signs;  ///< speed_limit_sign, stop_sign, yield_sign only
    std::vector<world::PlotT> plots;
    std::vector<world::DrawnBuildingT> buildings;
    std::vector<District> districts;
    std::vector<std::vector<world::Vec3>> keep_clear;  ///< no building or plant grows here
};

/// Reads one. Throws world::Error "file:line: what". `file` is for messages.
Place read_place(std::string_view xml, const std::string& file);

/// Equal places give equal bytes; read_place(place_xml(p)) == p to a millimetre.
std::string place_xml(const Place& place);

}  // namespace reprise::towns

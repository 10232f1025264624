#include "exchange/geo_origin.h"

#include <gmock/gmock.h>

namespace reprise::exchange {
namespace {

std::string network(const std::string& offset, const std::string& projection) {
    return "<net version=\"1.20\">\n  <location netOffset=\"" + offset +
           "\" convBoundary=\"0,0,1,1\" projParameter=\"" + projection + "\"/>\n</net>";
}

/// By definition zone 33's central meridian, 15 degrees east, is at 500 km, the equator at 0.
TEST(GeoOrigin, KnowsTheMiddleOfAUtmZone) {
    const auto origin =
        GeoOrigin::of(network("-500000.00,0.00", "+proj=utm +zone=33 +datum=WGS84 +units=m"));
    ASSERT_TRUE(origin);
    const Geodetic at = origin->at({0, 0, 0});
    EXPECT_NEAR(at.latitude_deg, 0, 1e-12);
    EXPECT_NEAR(at.longitude_deg, 15, 1e-12);
}

/// A minute of latitude is a nautical mile, 1852 m, give or take the shape of the Earth; UTM
/// shrinks by 0.9996.
TEST(GeoOrigin, GoesNorthByNauticalMiles) {
    const auto origin = GeoOrigin::of(
        network("-398790.46,-5809246.45", "+proj=utm +zone=33 +ellps=WGS84 +datum=WGS84 +no_defs"));
    ASSERT_TRUE(origin);
    const double minutes =
        60 * (origin->at({0, 1852, 0}).latitude_deg - origin->at({0, 0, 0}).latitude_deg);
    EXPECT_NEAR(minutes, 1, 0.005);
}

TEST(GeoOrigin, IsNowhereForAMadeUpTown) {
    EXPECT_FALSE(GeoOrigin::of(network("0.00,0.00", "!")));
    EXPECT_FALSE(GeoOrigin::of(network("0.00,0.00", "+proj=nonsense")));
    EXPECT_FALSE(GeoOrigin::of("<net/>"));
    EXPECT_FALSE(GeoOrigin::of("<location projParameter=\"+proj=utm +zone=33"));
}

}  // namespace
}  // namespace reprise::exchange

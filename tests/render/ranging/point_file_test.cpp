#include "render/point_file.h"

#include <array>
#include <bit>
#include <cstring>

#include <gtest/gtest.h>

#include "world/external/point_fields.h"

namespace reprise {

namespace {

/// One point, whose columns are 0 but for its object: somebody on foot in the background.
world::SensorFrame seen_walker(std::uint32_t id) {
    world::SensorFrame frame;
    frame.kind = world::SensorKind::semantic_lidar;
    const auto fields = world::point_fields(frame.kind);
    frame.type = world::PixelType::f32;
    frame.width = 1;
    frame.height = 1;
    frame.channels = static_cast<int>(fields.size());
    for (const world::PointField& field : fields) {
        const std::uint32_t word = field.name == "object" ? id : 0;
        const auto bytes = std::bit_cast<std::array<std::uint8_t, 4>>(word);
        frame.data.insert(frame.data.end(), bytes.begin(), bytes.end());
    }
    return frame;
}

/// Of the last `columns` numbers of a file that one.
template <typename Number>
Number number_at(const std::string& file, std::size_t columns, std::size_t column) {
    Number number{};
    std::memcpy(
        &number, file.data() + file.size() - (columns - column) * sizeof(number), sizeof(number));
    return number;
}

}  // namespace

TEST(PointFile, OfEveryFormatWithIdsHoldsThoseOfPeopleExactly) {
    const std::size_t object = 4;
    for (const std::uint32_t id : {100'000'001U, 100'000'002U, 100'000'399U}) {
        const world::SensorFrame frame = seen_walker(id);
        const auto fields = world::point_fields(frame.kind);
        ASSERT_EQ(fields[object].name, "object");
        const auto file = [&](render::PointFormat format) {
            return render::point_file(frame, format);
        };
        EXPECT_EQ(number_at<std::uint32_t>(file(render::PointFormat::ply), fields.size(), object),
                  id);
        EXPECT_EQ(number_at<std::uint32_t>(file(render::PointFormat::pcd), fields.size(), object),
                  id);
        EXPECT_EQ(number_at<double>(file(render::PointFormat::npy), fields.size(), object), id);
    }
}

}  // namespace reprise

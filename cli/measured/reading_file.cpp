#include "cli/measured/reading_file.h"

#include <fmt/format.h>

#include "files/output_file.h"
#include "render/point_file.h"

namespace reprise::cli {

std::string ReadingFile::csv() const {
    std::string text = "tick,time";
    for (const world::PointField& field : world::point_fields(kind_))
        text += fmt::format(",{}", field.name);
    text += '\n';
    for (const auto& [tick, readings] : rows_)
        for (const world::Reading& reading : readings) {
            text += fmt::format("{},{}", tick, static_cast<double>(tick) * step_);
            for (const double value : reading)
                text += fmt::format(",{}", value);
            text += '\n';
        }
    return text;
}

std::string ReadingFile::npy() const {
    std::vector<double> values;
    for (const auto& [tick, readings] : rows_)
        for (const world::Reading& reading : readings) {
            values.push_back(static_cast<double>(tick));
            values.push_back(static_cast<double>(tick) * step_);
            values.insert(values.end(), reading.begin(), reading.end());
        }
    return render::npy_file(values, world::point_fields(kind_).size() + 2);
}

void ReadingFile::write(const std::filesystem::path& path) const {
    files::write_file(path, "the readings", path.extension() == ".npy" ? npy() : csv());
}

}  // namespace reprise::cli

#include "render/look/lettering.h"

#include <algorithm>
#include <array>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include <opencv2/imgproc.hpp>

#include "render/shapes/fast_math.h"

namespace reprise::render {

namespace {

constexpr int capital = 24;  // [px] height of a capital letter in the picture
constexpr int finer = 4;     // drawn so much larger, then averaged: smooth edges, and integers only

/// Drawn when it is first read, by any thread: a picture shows few of all words.
class LateLettering {
  public:
    /// `word()` says what it reads.
    template <typename Word>
    const Lettering& of(const Word& word) {
        std::call_once(asked_, [&] { lettering_.emplace(word()); });
        return *lettering_;
    }

  private:
    std::once_flag asked_;
    std::optional<Lettering> lettering_;
};

}  // namespace

Lettering::Lettering(std::string_view text) {
    const std::string word(text);
    constexpr int font = cv::FONT_HERSHEY_DUPLEX;
    const double scale = finer * capital / 21.0;  // Hershey's capitals are 21 units high
    const int thickness = finer * capital / 7;
    int below = 0;
    const cv::Size size = cv::getTextSize(word, font, scale, thickness, &below);
    columns_ = size.width / finer + 6;
    rows_ = capital + 8;
    cv::Mat large = cv::Mat::zeros(rows_ * finer, columns_ * finer, CV_8U);
    const cv::Point start((columns_ * finer - size.width) / 2, (rows_ + capital) / 2 * finer);
    cv::putText(large, word, start, font, scale, cv::Scalar(255), thickness, cv::LINE_8);
    std::vector<int> sums;
    for (int row = 0; row < rows_; ++row) {
        sums.assign(static_cast<std::size_t>(columns_), 0);
        for (int fine_row = row * finer; fine_row < (row + 1) * finer; ++fine_row) {
            const std::uint8_t* fine = large.ptr(fine_row);
            for (int& sum : sums)
                for (int i = 0; i < finer; ++i)
                    sum += *fine++;
        }
        for (const int sum : sums)
            ink_.push_back(static_cast<std::uint8_t>(sum / (finer * finer)));
    }
}

float Lettering::at(int column, int row) const {
    if (column < 0 || row < 0 || column >= columns_ || row >= rows_)
        return 0;
    return static_cast<float>(ink_[static_cast<std::size_t>(row * columns_ + column)]) / 255;
}

float Lettering::ink(float x, float y) const {
    const float u = x * capital + 0.5F * static_cast<float>(columns_) - 0.5F;
    const float v = 0.5F * static_cast<float>(rows_) - y * capital - 0.5F;
    if (u < -1 || v < -1 || u > static_cast<float>(columns_) || v > static_cast<float>(rows_))
        return 0;
    const int column = floor_int(u);
    const int row = floor_int(v);
    const float share = u - static_cast<float>(column);
    return mix(mix(at(column, row), at(column + 1, row), share),
               mix(at(column, row + 1), at(column + 1, row + 1), share),
               v - static_cast<float>(row));
}

float Lettering::width() const {
    return static_cast<float>(columns_) / capital;
}

const Lettering& shop_name(std::uint32_t seed) {
    static constexpr std::array<std::string_view, 20> names{
        "BAKERY",     "CAFE",     "BOOKS",    "PHARMACY", "FLOWERS", "SHOES",  "OPTICIAN",
        "BARBER",     "BISTRO",   "TOYS",     "CYCLES",   "GROCERY", "TAILOR", "MUSIC",
        "WINE & TEA", "HARDWARE", "PIZZERIA", "PHOTO",    "DELI",    "LAUNDRY"};
    static std::array<LateLettering, names.size()> drawn;
    const std::size_t number = seed % names.size();
    return drawn[number].of([&] { return names[number]; });
}

const Lettering& number(std::uint32_t value) {
    static std::array<LateLettering, 200> drawn;
    const std::size_t written = std::min<std::size_t>(value, drawn.size() - 1);
    return drawn[written].of([&] { return std::to_string(written); });
}

const Lettering& stop_word() {
    static const Lettering word("STOP");
    return word;
}

}  // namespace reprise::render

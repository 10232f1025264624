#include "render/look/lettering.h"

#include <algorithm>
#include <array>
#include <string>

#include <opencv2/imgproc.hpp>

#include "render/shapes/fast_math.h"

namespace reprise::render {

namespace {

constexpr int capital = 24;  // [px] height of a capital letter in the picture
constexpr int finer = 4;     // drawn so much larger, then averaged: smooth edges, and integers only

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
    for (int row = 0; row < rows_; ++row) {
        for (int column = 0; column < columns_; ++column) {
            int sum = 0;
            for (int i = 0; i < finer * finer; ++i)
                sum += large.at<std::uint8_t>(row * finer + i / finer, column * finer + i % finer);
            ink_.push_back(static_cast<std::uint8_t>(sum / (finer * finer)));
        }
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
    static const std::array<Lettering, 20> names{
        Lettering("BAKERY"),   Lettering("CAFE"),  Lettering("BOOKS"),      Lettering("PHARMACY"),
        Lettering("FLOWERS"),  Lettering("SHOES"), Lettering("OPTICIAN"),   Lettering("BARBER"),
        Lettering("BISTRO"),   Lettering("TOYS"),  Lettering("CYCLES"),     Lettering("GROCERY"),
        Lettering("TAILOR"),   Lettering("MUSIC"), Lettering("WINE & TEA"), Lettering("HARDWARE"),
        Lettering("PIZZERIA"), Lettering("PHOTO"), Lettering("DELI"),       Lettering("LAUNDRY")};
    return names[seed % names.size()];
}

const Lettering& number(std::uint32_t value) {
    static const std::vector<Lettering> numbers = [] {
        std::vector<Lettering> all;
        for (int i = 0; i < 200; ++i)
            all.emplace_back(std::to_string(i));
        return all;
    }();
    return numbers[std::min<std::size_t>(value, numbers.size() - 1)];
}

const Lettering& stop_word() {
    static const Lettering word("STOP");
    return word;
}

}  // namespace reprise::render

#include "render/overlay/overlay.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "world/check.h"

namespace reprise::render {

namespace {

constexpr int font = cv::FONT_HERSHEY_SIMPLEX;
constexpr int smallest_letters = 8;    // [px] of a capital
constexpr int letters_in_height = 42;  // of the picture
constexpr double faint = 0.5;          // how much of a faint tag is seen
constexpr double shade_weight = 0.45;  // how dark it is behind letters

cv::Scalar color_of(Tone tone) {
    switch (tone) {
        case Tone::good:
            return {120, 230, 120};
        case Tone::bad:
            return {255, 110, 90};
        case Tone::plain:
            break;
    }
    return {255, 255, 255};
}

/// OpenCV's letters are ASCII: one sign in place of any other one.
std::string plain_letters(const std::string& text) {
    std::string plain;
    for (const char letter : text) {
        const auto byte = static_cast<unsigned char>(letter);
        if (byte >= 0x20 && byte < 0x7f)
            plain += letter;
        else if (byte >= 0xc0 || byte < 0x20)  // where a longer sign begins
            plain += '?';
    }
    return plain;
}

/// Letters of one size.
class Pen {
  public:
    Pen(cv::Mat& picture, int capital)
        : picture_(picture),
          capital_(capital),
          thickness_(std::max(1, static_cast<int>(std::lround(capital / 9.0)))),
          scale_(cv::getFontScaleFromHeight(font, capital, thickness_)),
          margin_(std::max(2, capital / 3)) {}

    int line() const { return capital_ + 3 * margin_; }

    int margin() const { return margin_; }

    /// With the margin around it.
    cv::Size size_of(const std::string& text) const {
        int below = 0;
        const cv::Size letters = cv::getTextSize(text, font, scale_, thickness_, &below);
        return {letters.width + 2 * margin_, line()};
    }

    /// As much of it as fits.
    std::string cut(std::string text, int width) const {
        while (!text.empty() && size_of(text).width > width)
            text.pop_back();
        return text;
    }

    /// Into an area of size_of(text), of which what is outside of the picture is left out.
    Area write(const std::string& text,
               cv::Point corner,
               const cv::Scalar& color,
               double weight = 1) {
        const cv::Rect wanted(corner, size_of(text));
        const cv::Rect area = wanted & cv::Rect(0, 0, picture_.cols, picture_.rows);
        if (area.empty())
            return {};
        cv::Mat below = picture_(area);
        cv::Mat drawn = below * (1 - shade_weight);
        const cv::Point at(wanted.x - area.x + margin_,
                           wanted.y - area.y + margin_ + margin_ / 2 + capital_);
        cv::putText(drawn, text, at, font, scale_, {0, 0, 0}, thickness_ + 2, cv::LINE_AA);
        cv::putText(drawn, text, at, font, scale_, color, thickness_, cv::LINE_AA);
        cv::addWeighted(drawn, weight, below, 1 - weight, 0, below);
        return {area.x, area.y, area.x + area.width, area.y + area.height};
    }

  private:
    cv::Mat& picture_;
    int capital_;
    int thickness_;
    double scale_;
    int margin_;
};

bool touch(const Area& one, const Area& other) {
    return one.left < other.right && other.left < one.right && one.top < other.bottom &&
           other.top < one.bottom;
}

cv::Mat pixels_of(world::SensorFrame& picture) {
    REPRISE_CHECK(picture.kind == world::SensorKind::rgb && picture.channels == 3, picture.name);
    return {picture.height, picture.width, CV_8UC3, picture.data.data()};
}

int capital_for(const cv::Mat& picture) {
    return std::max(smallest_letters, picture.rows / letters_in_height);
}

/// A thin line from a tag that had to rise down to its point.
void write_stem(cv::Mat& picture, const Area& area, const Tag& tag, std::vector<Area>& stems) {
    const int x = static_cast<int>(std::lround(tag.x));
    const int end = std::min(static_cast<int>(std::lround(tag.y)), picture.rows);
    const cv::Rect stem =
        cv::Rect(x, area.bottom, std::max(1, picture.rows / 400), end - area.bottom) &
        cv::Rect(0, 0, picture.cols, picture.rows);
    if (end - area.bottom < 3 || stem.empty())
        return;
    picture(stem) = picture(stem) * 0.3 + cv::Scalar(160, 160, 160);
    stems.push_back({stem.x, stem.y, stem.x + stem.width, stem.y + stem.height});
}

/// Over its point, higher where others are in the way already, and nowhere beyond the picture's
/// top. Who has no name gives way: in a jam not every car says how fast it is.
Area write_tag(Pen& pen, const cv::Mat& picture, const Tag& tag, std::vector<Area>& taken) {
    const std::string text = pen.cut(plain_letters(tag.text), picture.cols);
    const cv::Size size = pen.size_of(text);
    const auto fit = [](double wish, int room) {
        return static_cast<int>(std::clamp(wish, 0.0, static_cast<double>(std::max(room, 0))));
    };
    Area area;
    area.left = fit(std::round(tag.x - size.width / 2.0), picture.cols - size.width);
    area.top = fit(std::round(tag.y) - size.height, picture.rows - size.height);
    area.right = std::min(area.left + size.width, picture.cols);
    area.bottom = std::min(area.top + size.height, picture.rows);
    for (bool moved = true; moved;) {
        moved = false;
        for (const Area& other : taken)
            if (touch(area, other)) {
                if (!tag.named)
                    return {};
                area.top = other.top - size.height;
                area.bottom = other.top;
                moved = true;
            }
        if (area.top < 0)
            return {};
    }
    taken.push_back(area);
    const cv::Scalar color = tag.named ? cv::Scalar(255, 224, 120) : cv::Scalar(255, 255, 255);
    return pen.write(text, {area.left, area.top}, color, tag.hidden ? faint : 1);
}

}  // namespace

Written write_overlay(world::SensorFrame& picture,
                      std::span<const Tag> tags,
                      const OverlayText& text) {
    cv::Mat pixels = pixels_of(picture);
    Pen pen(pixels, capital_for(pixels));
    Written written;
    const auto write_line = [&](Pen& with, const OverlayLine& line, int left, int top) {
        const std::string fitting = with.cut(plain_letters(line.text), pixels.cols - left);
        if (!fitting.empty() && top >= 0)
            written.text.push_back(with.write(fitting, {left, top}, color_of(line.tone)));
    };

    // The corners first: tags keep clear of them.
    const int gap = pen.margin();
    int top = gap;
    for (const OverlayLine& line : text.clock) {
        write_line(pen, line, gap, top);
        top += pen.line();
    }
    if (text.verdict) {
        Pen large(pixels, 3 * capital_for(pixels) / 2);
        const std::string verdict = plain_letters(text.verdict->text);
        Pen& fitting = large.size_of(verdict).width + 2 * gap <= pixels.cols ? large : pen;
        const int width = fitting.size_of(verdict).width;
        write_line(fitting, *text.verdict, std::max(gap, (pixels.cols - width) / 2), top + gap);
    }
    // The latest ones, as far as they leave the middle of the picture free.
    int bottom = pixels.rows - gap;
    for (auto line = text.events.rbegin(); line != text.events.rend(); ++line) {
        bottom -= pen.line();
        if (line != text.events.rbegin() && bottom < pixels.rows * 2 / 3)
            break;
        write_line(pen, *line, gap, bottom);
    }

    // Who is nearest chooses first.
    std::vector<Area> taken = written.text;
    written.tags.resize(tags.size());
    for (const bool named : {true, false})
        for (std::size_t i = tags.size(); i-- > 0;) {
            if (tags[i].named != named)
                continue;
            written.tags[i] = write_tag(pen, pixels, tags[i], taken);
            if (written.tags[i].bottom > 0)
                write_stem(pixels, written.tags[i], tags[i], written.stems);
        }
    return written;
}

Area write_scale(world::SensorFrame& picture, double metres_per_pixel, double north) {
    cv::Mat pixels = pixels_of(picture);
    Pen pen(pixels, capital_for(pixels));
    // The longest round length that takes a quarter of the width.
    constexpr std::array lengths{1000, 500, 200, 100, 50, 20, 10, 5, 2, 1};
    const auto fits = std::find_if(lengths.begin(), lengths.end(), [&](int metres) {
        return metres / metres_per_pixel <= pixels.cols / 4.0;
    });
    if (fits == lengths.end() || !std::isfinite(metres_per_pixel))
        return {};
    const int length = static_cast<int>(std::lround(*fits / metres_per_pixel));
    const std::string text = fmt::format("{} m", *fits);
    const int line = pen.line();
    const int gap = pen.margin();
    const int width = std::max({length, pen.size_of(text).width}) + line + 3 * gap;
    const int height = 2 * line;
    if (width + gap > pixels.cols || height + gap > pixels.rows)
        return {};
    const cv::Rect area(pixels.cols - width - gap, pixels.rows - height - gap, width, height);
    cv::Mat corner = pixels(area);
    corner *= 1 - shade_weight;

    const int stroke = std::max(1, line / 12);
    const cv::Scalar white(255, 255, 255);
    const cv::Point left(gap, height - gap - stroke);
    const cv::Point right(gap + length, left.y);
    const cv::Point tick(0, line / 3);
    cv::line(corner, left, right, white, stroke, cv::LINE_AA);
    cv::line(corner, left, left - tick, white, stroke, cv::LINE_AA);
    cv::line(corner, right, right - tick, white, stroke, cv::LINE_AA);
    Pen(corner, capital_for(pixels)).write(text, {gap, gap}, white);

    // A needle to the north.
    const cv::Point2d middle(width - gap - line / 2.0, height / 2.0);
    const cv::Point2d way(std::cos(north) * 0.8 * line, -std::sin(north) * 0.8 * line);
    cv::arrowedLine(corner, middle - way, middle + way, white, stroke, cv::LINE_AA, 0, 0.4);
    return {area.x, area.y, area.x + area.width, area.y + area.height};
}

}  // namespace reprise::render

#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

namespace reprise::render {

/// A word as a small picture, for painting it on a surface at the hit.
class Lettering {
  public:
    explicit Lettering(std::string_view text);

    /// How much paint is at a place, in [0, 1]; x to the right and y up from the word's middle, in
    /// heights of a capital letter.
    float ink(float x, float y) const;

    /// In heights of a capital letter.
    float width() const;

  private:
    float at(int column, int row) const;

    int columns_ = 0;
    int rows_ = 0;
    std::vector<std::uint8_t> ink_;  // by rows from the top
};

/// What stands over a shop, by seed.
const Lettering& shop_name(std::uint32_t seed);

/// The number on a sign; values above 199 are written as 199.
const Lettering& number(std::uint32_t value);

/// STOP
const Lettering& stop_word();

}  // namespace reprise::render

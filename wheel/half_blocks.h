#pragma once

#include <string>

#include "wheel/image.h"

namespace reprise::wheel {

/// The image as text for a terminal of true colours: each character is the half block U+2580,
/// whose upper half has one colour and whose lower half another. As large as `columns` x `rows`
/// characters hold with the image's proportions (half a character is about as wide as high);
/// colours are means. Lines end with carriage return and line feed.
std::string half_blocks(const Image& image, int columns, int rows);

}  // namespace reprise::wheel

#pragma once
// Many small pictures on one sheet, each with its hour below it.
#include <string>
#include <vector>

#include "engine/base/image.h"

namespace daylit {

/// Averages blocks of factor x factor pixels; what is left over at the right and lower edge is dropped.
Image shrink(const Image& image, int factor);

/// Writes digits, ':', '-' and spaces, 5 x 7 dots each of scale x scale pixels, with the upper left corner at (x, y);
/// other characters are left blank, and dots outside the image too.
void draw_text(Image& image, int x, int y, const std::string& text, int scale, const Rgb& color);
int text_width(const std::string& text, int scale);

class ContactSheet {
  public:
    /// Room for `count` pictures of this size, shrunk by a whole factor so that the sheet is at most 2400 pixels wide and
    /// about as wide as a screen is.
    ContactSheet(int count, int width, int height);
    /// The next picture, display-linear in [0,1], of the size named above.
    void add(const Image& picture, const std::string& label);
    const Image& image() const { return sheet_; }

  private:
    int columns_ = 1, factor_ = 1, tile_width_ = 1, tile_height_ = 1, added_ = 0;
    Image sheet_;
};

}  // namespace daylit

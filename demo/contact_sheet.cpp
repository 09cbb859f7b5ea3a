#include "demo/contact_sheet.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstdint>

namespace daylit {
namespace {

constexpr int kGlyphWidth = 5, kGlyphHeight = 7, kAdvance = 6;
constexpr int kGap = 6, kTextScale = 2;
constexpr int kLabelHeight = kGlyphHeight * kTextScale + 8;
constexpr int kWidestSheet = 2400, kNarrowestTile = 64;
constexpr double kSheetAspect = 16.0 / 9.0;
const Rgb kPaper(0.012f), kInk(0.6f);

/// Rows of five dots, the leftmost in bit 4.
std::array<std::uint8_t, kGlyphHeight> glyph(char c) {
    switch (c) {
        case '0': return {0x0E, 0x11, 0x13, 0x15, 0x19, 0x11, 0x0E};
        case '1': return {0x04, 0x0C, 0x04, 0x04, 0x04, 0x04, 0x0E};
        case '2': return {0x0E, 0x11, 0x01, 0x06, 0x08, 0x10, 0x1F};
        case '3': return {0x1F, 0x02, 0x04, 0x06, 0x01, 0x11, 0x0E};
        case '4': return {0x02, 0x06, 0x0A, 0x12, 0x1F, 0x02, 0x02};
        case '5': return {0x1F, 0x10, 0x1E, 0x01, 0x01, 0x11, 0x0E};
        case '6': return {0x06, 0x08, 0x10, 0x1E, 0x11, 0x11, 0x0E};
        case '7': return {0x1F, 0x01, 0x02, 0x04, 0x08, 0x08, 0x08};
        case '8': return {0x0E, 0x11, 0x11, 0x0E, 0x11, 0x11, 0x0E};
        case '9': return {0x0E, 0x11, 0x11, 0x0F, 0x01, 0x02, 0x0C};
        case ':': return {0x00, 0x04, 0x04, 0x00, 0x04, 0x04, 0x00};
        case '-': return {0x00, 0x00, 0x00, 0x0E, 0x00, 0x00, 0x00};
        default: return {};
    }
}

void fill(Image& image, int x0, int y0, int width, int height, const Rgb& color) {
    for (int y = std::max(y0, 0); y < std::min(y0 + height, image.height); ++y) {
        for (int x = std::max(x0, 0); x < std::min(x0 + width, image.width); ++x) image.at(x, y) = color;
    }
}

/// The number of columns whose sheet comes nearest to the wanted shape.
int best_columns(int count, int width, int height) {
    int best = 1;
    double best_error = 1e9;
    for (int columns = 1; columns <= count; ++columns) {
        const int rows = (count + columns - 1) / columns;
        const double error = std::abs(std::log(double(columns) * width / (double(rows) * height) / kSheetAspect));
        if (error < best_error) {
            best_error = error;
            best = columns;
        }
    }
    return best;
}

}  // namespace

Image shrink(const Image& image, int factor) {
    assert(factor >= 1);
    Image small(std::max(image.width / factor, 1), std::max(image.height / factor, 1));
    const int across = std::min(factor, image.width), down = std::min(factor, image.height);
    for (int y = 0; y < small.height; ++y) {
        for (int x = 0; x < small.width; ++x) {
            Rgb sum(0.0f);
            for (int j = 0; j < down; ++j) {
                for (int i = 0; i < across; ++i) sum += image.at(x * factor + i, y * factor + j);
            }
            small.at(x, y) = sum / float(across * down);
        }
    }
    return small;
}

int text_width(const std::string& text, int scale) {
    return text.empty() ? 0 : (int(text.size()) * kAdvance - (kAdvance - kGlyphWidth)) * scale;
}

void draw_text(Image& image, int x, int y, const std::string& text, int scale, const Rgb& color) {
    for (const char c : text) {
        const auto rows = glyph(c);
        for (int row = 0; row < kGlyphHeight; ++row) {
            for (int dot = 0; dot < kGlyphWidth; ++dot) {
                const bool set = (rows[std::size_t(row)] >> (kGlyphWidth - 1 - dot)) & 1;
                if (set) fill(image, x + dot * scale, y + row * scale, scale, scale, color);
            }
        }
        x += kAdvance * scale;
    }
}

ContactSheet::ContactSheet(int count, int width, int height) {
    assert(count >= 1 && width >= 1 && height >= 1);
    columns_ = best_columns(count, width, height);
    const int widest_tile = std::max((kWidestSheet - kGap) / columns_ - kGap, kNarrowestTile);
    factor_ = (width + widest_tile - 1) / widest_tile;
    tile_width_ = std::max(width / factor_, 1);
    tile_height_ = std::max(height / factor_, 1);
    const int rows = (count + columns_ - 1) / columns_;
    sheet_ = Image(columns_ * (tile_width_ + kGap) + kGap, rows * (tile_height_ + kLabelHeight) + kGap, kPaper);
}

void ContactSheet::add(const Image& picture, const std::string& label) {
    const int x0 = kGap + added_ % columns_ * (tile_width_ + kGap);
    const int y0 = kGap + added_ / columns_ * (tile_height_ + kLabelHeight);
    ++added_;
    const Image tile = shrink(picture, factor_);
    for (int y = 0; y < tile_height_; ++y) {
        for (int x = 0; x < tile_width_; ++x) sheet_.at(x0 + x, y0 + y) = tile.at(x, y);
    }
    const int left = x0 + (tile_width_ - text_width(label, kTextScale)) / 2;
    draw_text(sheet_, left, y0 + tile_height_ + 3, label, kTextScale, kInk);
}

}  // namespace daylit

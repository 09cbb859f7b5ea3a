#pragma once
// Floating-point images in memory, and reading and writing them through OpenImageIO.
#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "engine/base/units.h"

namespace daylit {

/// Linear RGB image, 32-bit float, row 0 on top, no padding. Scene-referred (cd/m^2) unless said otherwise.
struct Image {
    int width = 0;
    int height = 0;
    std::vector<Rgb> pixels;  // width * height, row by row

    Image() = default;
    Image(int w, int h, Rgb fill = Rgb(0.0f)) : width(w), height(h), pixels(std::size_t(w) * std::size_t(h), fill) {}
    Rgb& at(int x, int y) { return pixels[std::size_t(y) * std::size_t(width) + std::size_t(x)]; }
    const Rgb& at(int x, int y) const { return pixels[std::size_t(y) * std::size_t(width) + std::size_t(x)]; }
    bool empty() const { return pixels.empty(); }
};

/// 8-bit RGBA image as textures are stored; row 0 on top. Whether RGB is sRGB-coded is up to its user.
struct Image8 {
    int width = 0;
    int height = 0;
    std::vector<std::uint8_t> rgba;  // 4 * width * height
};

/// Limits that keep a lying file from exhausting memory; larger declared sizes throw Error before any pixel is read.
inline constexpr int kMaxImageSide = 16384;
inline constexpr std::size_t kMaxImagePixels = std::size_t(1) << 27;

/// Reads the first three channels (by name R, G, B where named; a single channel is copied to all three) as stored
/// linear floats from .exr, .hdr, .pfm, ... PNG and JPEG are decoded from sRGB to linear.
/// throws Error when absent, damaged, too large or empty. Values are returned as stored (NaN and negatives included).
Image read_image(const std::filesystem::path& path);

/// Reads an 8-bit texture from a file or from bytes in memory (PNG, JPEG, ...). `name` stands in error messages.
Image8 read_image8(const std::filesystem::path& path);
Image8 read_image8(std::span<const std::uint8_t> bytes, const std::string& name);

/// Width and height that an encoded image declares; reads no pixel. throws as read_image8.
std::array<int, 2> declared_image_size(std::span<const std::uint8_t> bytes, const std::string& name);

/// Writes by extension: .exr linear 32-bit float, .png 8-bit after `encode_srgb` of values in [0,1] (display-referred
/// input). Whole file or nothing: a temporary beside the target, then rename. `comment` goes into the header.
/// throws Error when the extension is unknown or the place is not writable.
void write_image(const std::filesystem::path& path, const Image& image, const std::string& comment = {});

/// sRGB transfer function (IEC 61966-2-1), per channel; input outside [0,1] is clamped.
float encode_srgb(float linear);
float decode_srgb(float coded);

}  // namespace daylit

#include "engine/render/mipmaps.h"

#include <algorithm>
#include <array>

namespace daylit {
namespace {

constexpr std::size_t kSteps = 65535;  // of light between black and white, fine enough for the darkest codes

/// Code to light, in steps; light to code.
struct Coding {
    explicit Coding(bool srgb) : code(kSteps + 1) {
        for (std::size_t i = 0; i < light.size(); ++i) {
            const float coded = float(i) / 255.0f;
            light[i] = std::uint32_t((srgb ? decode_srgb(coded) : coded) * float(kSteps) + 0.5f);
        }
        for (std::size_t i = 0; i < code.size(); ++i) {
            const float value = float(i) / float(kSteps);
            code[i] = std::uint8_t((srgb ? encode_srgb(value) : value) * 255.0f + 0.5f);
        }
    }
    std::array<std::uint32_t, 256> light;
    std::vector<std::uint8_t> code;
};

const Coding& coding(bool srgb) {
    static const Coding plain(false), coded(true);
    return srgb ? coded : plain;
}

/// The texels of the level above that one of this level covers, along one side.
struct Span {
    int first, last;
};
Span covered(int at, int side, int above) {
    return {at * above / side, ((at + 1) * above + side - 1) / side - 1};
}

Image8 halved(const Image8& above, const Coding& rgb, const Coding& alpha) {
    Image8 level{std::max(1, above.width / 2), std::max(1, above.height / 2), {}};
    level.rgba.resize(4 * std::size_t(level.width) * std::size_t(level.height));
    std::uint8_t* out = level.rgba.data();
    for (int y = 0; y < level.height; ++y) {
        const Span rows = covered(y, level.height, above.height);
        for (int x = 0; x < level.width; ++x, out += 4) {
            const Span columns = covered(x, level.width, above.width);
            std::array<std::uint32_t, 4> sum{};
            for (int row = rows.first; row <= rows.last; ++row) {
                const std::uint8_t* in =
                    &above.rgba[4 * (std::size_t(row) * std::size_t(above.width) + std::size_t(columns.first))];
                for (int column = columns.first; column <= columns.last; ++column, in += 4) {
                    for (std::size_t c = 0; c < 3; ++c) sum[c] += rgb.light[in[c]];
                    sum[3] += alpha.light[in[3]];
                }
            }
            const auto count = std::uint32_t((rows.last - rows.first + 1) * (columns.last - columns.first + 1));
            for (std::size_t c = 0; c < 3; ++c) out[c] = rgb.code[(sum[c] + count / 2) / count];
            out[3] = alpha.code[(sum[3] + count / 2) / count];
        }
    }
    return level;
}

}  // namespace

std::vector<Image8> mipmaps(const Image8& image, bool srgb) {
    std::vector<Image8> levels;
    for (const Image8* above = &image; above->width > 1 || above->height > 1; above = &levels.back())
        levels.push_back(halved(*above, coding(srgb), coding(false)));
    return levels;
}

}  // namespace daylit

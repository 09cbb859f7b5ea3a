#include "engine/baked/integer_coding.h"

#include <algorithm>

namespace daylit {

void put_integers(ByteWriter& w, const std::vector<std::int16_t>& values) {
    Bytes bytes(2 * values.size());
    for (std::size_t i = 0; i < values.size(); ++i) {
        const int v = values[i];
        const auto folded = std::uint16_t(v < 0 ? -2 * v - 1 : 2 * v);
        bytes[i] = std::uint8_t(folded & 0xFFu);
        bytes[values.size() + i] = std::uint8_t(folded >> 8);
    }
    w.put_all(bytes);
}

std::vector<std::int16_t> get_integers(ByteReader& r, std::size_t count) {
    const std::vector<std::uint8_t> low = r.get_all<std::uint8_t>(count), high = r.get_all<std::uint8_t>(count);
    std::vector<std::int16_t> values(count);
    for (std::size_t i = 0; i < count; ++i) {
        const int folded = low[i] | high[i] << 8;
        values[i] = std::int16_t(folded & 1 ? -(folded + 1) / 2 : folded / 2);
    }
    return values;
}

std::int16_t predicted_texel(const std::int16_t* plane, int width, int side, int x, int y) {
    const std::int16_t* at = plane + std::ptrdiff_t(y) * width + x;
    const bool has_left = x % side != 0, has_above = y % side != 0;
    if (!has_left) return has_above ? at[-width] : std::int16_t(0);
    const int left = at[-1];
    if (!has_above) return std::int16_t(left);
    const int above = at[-width], corner = at[-width - 1];
    return std::int16_t(std::clamp(left + above - corner, std::min(left, above), std::max(left, above)));
}

}  // namespace daylit

#include "engine/baked/integer_coding.h"

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

}  // namespace daylit

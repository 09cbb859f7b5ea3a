#include "engine/baked/integer_coding.h"

namespace daylit {
namespace {

constexpr int kBeyond = 3;  // of two bits: more is said elsewhere
constexpr std::size_t kToAByte = 4;

int folded(std::int16_t v) {
    return v < 0 ? -2 * v - 1 : 2 * v;
}

std::int16_t unfolded(int folded) {
    return std::int16_t(folded & 1 ? -(folded + 1) / 2 : folded / 2);
}

}  // namespace

void put_integers(ByteWriter& w, const std::vector<std::int16_t>& values) {
    Bytes bytes(2 * values.size());
    for (std::size_t i = 0; i < values.size(); ++i) {
        const int folded = daylit::folded(values[i]);
        bytes[i] = std::uint8_t(folded & 0xFFu);
        bytes[values.size() + i] = std::uint8_t(folded >> 8);
    }
    w.put_all(bytes);
}

std::vector<std::int16_t> get_integers(ByteReader& r, std::size_t count) {
    const std::vector<std::uint8_t> low = r.get_all<std::uint8_t>(count), high = r.get_all<std::uint8_t>(count);
    std::vector<std::int16_t> values(count);
    for (std::size_t i = 0; i < count; ++i) values[i] = unfolded(low[i] | high[i] << 8);
    return values;
}

void put_small_integers(ByteWriter& w, std::span<const std::int16_t> values) {
    Bytes pairs((values.size() + kToAByte - 1) / kToAByte, 0), low, high;
    for (std::size_t i = 0; i < values.size(); ++i) {
        const int number = folded(values[i]), beyond = number - kBeyond;
        pairs[i / kToAByte] |= std::uint8_t(std::min(number, kBeyond) << i % kToAByte * 2);
        if (beyond < 0) continue;
        low.push_back(std::uint8_t(beyond & 0xFF)), high.push_back(std::uint8_t(beyond >> 8));
    }
    w.put(std::uint64_t(values.size()));
    w.put_all(pairs), w.put_all(low), w.put_all(high);
}

std::vector<std::int16_t> get_small_integers(ByteReader& r, std::size_t count) {
    if (r.get<std::uint64_t>() != count) r.fail("holds another number of integers than it should");
    const std::vector<std::uint8_t> pairs = r.get_all<std::uint8_t>((count + kToAByte - 1) / kToAByte);
    const auto pair = [&](std::size_t i) { return pairs[i / kToAByte] >> i % kToAByte * 2 & kBeyond; };
    std::size_t large = 0;
    for (std::size_t i = 0; i < count; ++i) large += pair(i) == kBeyond;
    const std::vector<std::uint8_t> low = r.get_all<std::uint8_t>(large), high = r.get_all<std::uint8_t>(large);
    std::vector<std::int16_t> values(count);
    for (std::size_t i = 0, at = 0; i < count; ++i) {
        int number = pair(i);
        if (number == kBeyond) number += low[at] | high[at] << 8, ++at;
        values[i] = unfolded(number);
    }
    return values;
}

}  // namespace daylit

#include "engine/baked/record_coding.h"

#include "engine/baked/integer_coding.h"

namespace daylit {
namespace {

/// For each number of red or blue, its index and that of green's.
template <class Use>
void for_red_and_blue(std::size_t count, std::size_t records, const Use& use) {
    for (std::size_t plane = 0; plane + 3 * records <= count && records > 0; plane += 3 * records)
        for (const std::size_t channel : {0, 2})
            for (std::size_t s = 0; s < records; ++s) use(plane + channel * records + s, plane + records + s);
}

}  // namespace

template <class Integer>
void put_planes(ByteWriter& w, std::span<const Integer> numbers, std::size_t records) {
    std::vector<std::int16_t> kept(numbers.begin(), numbers.end());
    for_red_and_blue(numbers.size(), records,
                     [&](std::size_t i, std::size_t green) { kept[i] = Integer(numbers[i] - numbers[green]); });
    put_small_integers(w, kept);
}

template <class Integer>
std::vector<Integer> get_planes(ByteReader& r, std::size_t count, std::size_t records) {
    const std::vector<std::int16_t> kept = get_small_integers(r, count);
    std::vector<Integer> numbers(kept.begin(), kept.end());
    for_red_and_blue(count, records,
                     [&](std::size_t i, std::size_t green) { numbers[i] = Integer(numbers[i] + numbers[green]); });
    return numbers;
}

template void put_planes(ByteWriter&, std::span<const std::int8_t>, std::size_t);
template void put_planes(ByteWriter&, std::span<const std::int16_t>, std::size_t);
template std::vector<std::int8_t> get_planes(ByteReader&, std::size_t, std::size_t);
template std::vector<std::int16_t> get_planes(ByteReader&, std::size_t, std::size_t);

}  // namespace daylit

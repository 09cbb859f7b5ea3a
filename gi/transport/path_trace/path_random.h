#pragma once
// The random numbers of one path. Those that decide most of a picture's noise - where in the pixel, where on the sun,
// which lamp, where on an emitter, where the first bounce goes - are spread evenly over a group of samples; all others
// are independent.
#include "engine/base/random.h"
#include "engine/base/units.h"

namespace daylit {

/// Pairs of dimensions that are spread evenly over a group; each may be asked for once a path.
enum class Net : std::uint64_t { Pixel = 1, Sun, Lamp, Emitter, Bounce };

class PathRandom {
  public:
    /// group_size   a power of two up to 65536; the samples 0 .. group_size - 1 of a receiver form the first group, and
    ///              so on. Groups are independent of each other.
    PathRandom(std::uint64_t seed, std::uint64_t receiver, std::uint64_t sample, std::uint32_t group_size)
        : random_(seed, receiver, sample),
          group_(mix64(mix64(seed) ^ receiver) ^ sample / group_size),
          mask_(group_size - 1),
          index_(std::uint32_t(sample) & mask_) {}

    std::uint64_t bits() { return random_.bits(); }
    float next() { return random_.next(); }
    Vec2 pair() {
        const std::uint64_t both = random_.bits();
        return {unit(std::uint32_t(both >> 32)), unit(std::uint32_t(both))};
    }

    /// A point of a (0,2)-net over the group: Sobol's first two dimensions, order and digits scrambled as Owen 1995 by
    /// the hash of Laine and Karras 2011 (Burley 2020). Alone, it is uniform; nets are independent of each other.
    Vec2 pair(Net net) const {
        const std::uint64_t seeds = mix64(group_ ^ std::uint64_t(net) * 0x9E3779B97F4A7C15ull);
        const std::uint32_t order = std::uint32_t(seeds * 0x2545F491ull >> 32);
        const std::uint32_t i = reversed(scrambled(reversed(index_), order)) & mask_;
        // The first dimension is i mirrored at the binary point: scrambled, i need not be mirrored before and after.
        return {unit(reversed(scrambled(i, std::uint32_t(seeds)))),
                unit(reversed(scrambled(mirrored_sobol_second(i), std::uint32_t(seeds >> 32))))};
    }

  private:
    static float unit(std::uint32_t bits) { return float(bits >> 8) * 0x1p-24f; }
    static std::uint32_t reversed(std::uint32_t x) {
        x = __builtin_bswap32(x);
        x = ((x & 0x0F0F0F0Fu) << 4) | ((x & 0xF0F0F0F0u) >> 4);
        x = ((x & 0x33333333u) << 2) | ((x & 0xCCCCCCCCu) >> 2);
        return ((x & 0x55555555u) << 1) | ((x & 0xAAAAAAAAu) >> 1);
    }
    /// Of mirrored digits: every digit is flipped by a hash of the digits below it.
    static std::uint32_t scrambled(std::uint32_t x, std::uint32_t seed) {
        x += seed;
        x ^= x * 0x6C50B47Cu;
        x ^= x * 0xB82F1E52u;
        x ^= x * 0xC7AFE638u;
        return x ^ x * 0x8D22F6E6u;
    }
    /// Digits of the second dimension, mirrored at the binary point: those of i times Pascal's triangle modulo 2, which
    /// is a product of one sparse matrix a digit of the digit's own number.
    static std::uint32_t mirrored_sobol_second(std::uint32_t i) {
        i ^= i >> 16;
        i ^= (i & 0xFF00FF00u) >> 8;
        i ^= (i & 0xF0F0F0F0u) >> 4;
        i ^= (i & 0xCCCCCCCCu) >> 2;
        return i ^ (i & 0xAAAAAAAAu) >> 1;
    }

    Random random_;
    std::uint64_t group_;
    std::uint32_t mask_, index_;
};

}  // namespace daylit

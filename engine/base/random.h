#pragma once
// Counter-based random numbers: a pure function of who asks and for what, so that results do not depend on the number
// of threads, on order, or on interruption.
#include <cstdint>

namespace daylit {

/// Bijective 64-bit mixer (splitmix64 finaliser; Steele, Lea, Flood 2014).
inline std::uint64_t mix64(std::uint64_t x) {
    x += 0x9E3779B97F4A7C15ull;
    x = (x ^ (x >> 30)) * 0xBF58476D1CE4E5B9ull;
    x = (x ^ (x >> 27)) * 0x94D049BB133111EBull;
    return x ^ (x >> 31);
}

/// One independent stream per (seed, receiver, ray); each call of next() is the next dimension of that stream.
class Random {
  public:
    Random(std::uint64_t seed, std::uint64_t receiver, std::uint64_t ray)
        : key_(mix64(mix64(mix64(seed) ^ receiver) ^ ray)) {}

    std::uint64_t bits() { return mix64(key_ ^ (++dimension_ * 0xD1342543DE82EF95ull)); }
    /// Uniform in [0,1), 24 bits.
    float next() { return float(bits() >> 40) * 0x1p-24f; }
    /// Uniform in [0,1), 53 bits.
    double next_double() { return double(bits() >> 11) * 0x1p-53; }

  private:
    std::uint64_t key_;
    std::uint64_t dimension_ = 0;
};

}  // namespace daylit

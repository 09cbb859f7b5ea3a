#pragma once
// Which stream of random numbers belongs to which rays, so that no two share theirs.
#include <cstdint>

namespace daylit {

inline constexpr std::uint64_t kLampStream = 1, kSunStream = 2, kProbeStream = 3;  // texels' gather has 0

}  // namespace daylit

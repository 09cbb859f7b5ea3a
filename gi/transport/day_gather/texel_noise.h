#pragma once
// How noisy the gathered light of texels is, as its own rays tell.
#include <array>
#include <span>
#include <vector>

#include "gi/transport/day_gather/day_gather.h"

namespace daylit {

inline constexpr std::size_t kNoiseMoments = 12;  // at which noise is judged
using AtMoments = std::array<float, kNoiseMoments>;

/// Luminance of rows of components at those moments.
class MomentLight {
  public:
    /// weights   per moment: of the components (DayBasisCurves::weights)
    explicit MomentLight(std::span<const std::vector<Rgb>> weights);
    AtMoments of(const Rgb* row) const;

  private:
    std::size_t components_;
    std::vector<AtMoments> weights_;  // [component][channel]
};

/// Per texel: standard error of the gathered light over the light itself, the worst of the moments. As of independent
/// rays: stratified ones do better. Light below 1e-4 of the texels' mean counts as that.
std::vector<float> texel_noise(const GatherHits& hits, const DaySolution& day, const MomentLight& moments);

}  // namespace daylit

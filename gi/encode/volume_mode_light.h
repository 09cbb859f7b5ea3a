#pragma once
// Volumes as other schemes would keep them and look light up in them, to compare with what the runtime does.
#include <span>
#include <vector>

#include "engine/baked/irradiance_volume.h"
#include "gi/encode/volume_modes.h"

namespace daylit {

/// What a scheme keeps of radiance SH, and how it asks for irradiance.
enum class VolumeBands {
    Two,    // l = 0 and 1
    Zh3,    // l = 0 and 1; a zonal third band is guessed from them (Roughton, Sloan, Silvennoinen, Iwanicki, Shirley
            // 2024)
    Three,  // l = 0 to 2, as the runtime
    Four  // l = 0 to 3: the clamped cosine has no part of l = 3 (Ramamoorthi and Hanrahan 2001), so that irradiance is
          // that of three and only bytes are more
};

struct VolumeScheme {
    VolumeBlend blend = VolumeBlend::Adini;
    VolumeBands bands = VolumeBands::Three;
    bool grid = false;  // all cells of one size, found without a tree
};

/// Bytes as the file's sections would keep it: records of the bands and, where the blend uses them, their changes; the
/// tree but for grids, of which neither cells nor walls are counted.
double stored_bytes(const IrradianceVolume& volume, const VolumeScheme& mode);

/// A volume at one moment.
class VolumeModeLight {
  public:
    /// volume   encoded for the mode's blend (VolumeSettings::blend), not empty; must outlive this
    /// throws Error when a grid is asked for and cells differ in size
    VolumeModeLight(const IrradianceVolume& volume, const VolumeScheme& mode, std::span<const Rgb> weights);

    /// As VolumeLight::irradiance(), lux.
    Rgb irradiance(const Vec3& place, const Vec3& normal) const;

  private:
    glsl::VolumePlace find(const Vec3& place) const;
    void lay_table();

    const IrradianceVolume& volume_;
    VolumeScheme mode_;
    int numbers_ = 0;            // coefficients * 3
    std::vector<float> values_;  // [record][number]
    std::vector<Vec4> records_;  // [record][number]; one of the two is empty
    glsl::VolumeArrays arrays_{};
    std::vector<std::uint32_t> table_;  // of grids: what the tree's nodes say, x fastest
    std::array<int, 3> size_{};         // cells of it
    float per_metre_ = 1.0f;
};

/// Irradiance, lux, from radiance SH of two bands (c[0] to c[3]) with a zonal third about the axis of the luminance's
/// second, as large as lights usually have it for that second band (Roughton et al. 2024, "ZH3: Quadratic Zonal
/// Harmonics").
Rgb zh3_irradiance(const glsl::VolumeSh& sh, const Vec3& normal);

}  // namespace daylit

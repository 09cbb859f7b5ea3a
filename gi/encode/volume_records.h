#pragma once
// Records of an irradiance volume as whole numbers of steps, each record's by its own light in the channel.
#include <span>

#include "engine/baked/irradiance_volume.h"

namespace daylit {

/// Fills values, changes and their steps; tree and basis are there. Components are such that a row's length in them is
/// its brightness (gi/encode/judged_basis.h), so one step serves all of them: small ones cost few bits.
///
/// records   [record][value, change a metre along x, y, z][coefficient * 3 + channel][component]
///
/// noise     of irradiance by rounding values, as a share of the record's own in the channel: RMS over normals, moments
void store_records(std::span<const float> records, float noise, IrradianceVolume& volume);

}  // namespace daylit

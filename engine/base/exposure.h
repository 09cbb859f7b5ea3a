#pragma once
// From scene-referred radiance to what a display shows; one definition for shot, reference, walk and compare.
#include "engine/base/image.h"

namespace daylit {

/// EV100 that a reflected-light meter would choose: EV = log2(L_average * 100 / 12.5) (ISO 2720, K = 12.5), where
/// L_average is the log-average luminance of the middle 80 % by luminance of the pixels that are lit at all, i.e. above
/// 1e-4 cd/m^2. Never below -3, so that what is darker than moonlight is shown dark, as eyes see it; so is a black or
/// empty picture.
double auto_ev(const Image& radiance);

/// Factor from cd/m^2 to display-linear 1.0 before the tone curve: 1 / (1.2 * 2^EV) (ISO 12232 saturation speed).
double exposure_from_ev(double ev);

/// Exposed, tone-mapped (shaders/shared/tonemap.h), display-linear image in [0,1]; write_image codes it to sRGB.
Image tonemap(const Image& radiance, double ev);

}  // namespace daylit

#pragma once
// Light is linear, so the light of any hour and weather is a sum of parts, each times a scale:
//
//   light(hour) = sun * S(hour) + clear * K(hour) + overcast * O + ground * G + night * N + evening * V + C
//
//   S  the sun where it stands at that hour, 1 lux on a plane facing it      (fixed suns: all of them as they are)
//   K  the clear sky of that hour, and below the horizon the ground lit by it  (fixed skies and images: as they are)
//   O  the overcast sky (Moon and Spencer 1942), 1 cd/m^2 at the zenith, and the ground lit by it
//   G  the ground below the horizon under 1 lux of sun
//   N  starlight and airglow, and the ground under them
//   V  lamps and emission that are lit in the evening only, at their full strength
//   C  the scene's other lamps and emission
//
// So a baker that answers each part once serves every cloud cover and every colour of the sun.
#include "engine/base/units.h"

namespace daylit {

struct LightScales {
    Rgb sun = Rgb(0.0f);       // lux on a plane facing the sun; 1 for fixed suns
    float clear = 0.0f;        // share of the clear sky that shows; 1 for fixed skies
    Rgb overcast = Rgb(0.0f);  // cd/m^2 at the overcast sky's zenith
    Rgb ground = Rgb(0.0f);    // lux of the sun on level ground, as seen below the horizon
    float night = 0.0f;
    float evening = 1.0f;  // share of their full light; follows the sun (evening_share() in sky.h)
    bool operator==(const LightScales&) const = default;
};

}  // namespace daylit

#pragma once
// What `daylit report` varies of a method: each method lists its own settings beside its code.
#include <string>
#include <vector>

#include "gi/bake.h"

namespace daylit {

/// One bake of a sweep.
struct SweepPoint {
    std::string axis;  // the one thing that differs from the base settings, e.g. "rays"
    std::string name;  // unique among the points of a method, e.g. "rays x 0.5"
    BakeSettings settings;
};

}  // namespace daylit

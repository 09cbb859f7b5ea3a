#pragma once
// The walk itself, from the window's opening to its closing.
#include "demo/options.h"
#include "demo/walk/state.h"

namespace daylit {

struct WalkStart {
    WalkState state;
    std::vector<NodeMove> moves;
    double seconds = 0.0;  // on the animations' clocks
    Size size;
};

/// throws Error when there is no display, or for an unusable sky.
void walk_loop(const LoadedScene& loaded, const WalkStart& start);

}  // namespace daylit

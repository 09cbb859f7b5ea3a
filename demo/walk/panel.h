#pragma once
// The panel at the window's left edge and the help page: Dear ImGui over WalkState.
#include "demo/walk/state.h"
#include "engine/render/renderer.h"

namespace daylit {

/// What the panel tells and cannot change.
struct PanelFacts {
    const Scene* scene = nullptr;
    const Baked* baked = nullptr;  // may be null
    const FrameReport* frame = nullptr;
    double frame_milliseconds = 0.0;
    bool mouse_captured = false;
};

void draw_panel(WalkState& state, const PanelFacts& facts);
void draw_help(WalkState& state);

}  // namespace daylit

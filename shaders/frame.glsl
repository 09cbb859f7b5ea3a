// The frame's block, as every pass of the camera sees it.
#include "shaders/shared/frame_block.h"
layout(std140, binding = 0) uniform Frame { FrameBlock frame; };

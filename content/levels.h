#pragma once
// Every level that `daylit make` knows, each made by one function.
#include "content/level.h"

namespace daylit::content {

Level koldinghus();

// One thing each; camera "view". See content_scenes() for what each proves.
Level furnace(), cornell_box(), two_rooms(), thin_wall(), sealed_room(), maze(), tunnel(), glossy_floor(), caustic();

}  // namespace daylit::content

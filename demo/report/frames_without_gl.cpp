#include "demo/report/frames.h"

namespace daylit {

std::unique_ptr<FrameMaker> FrameMaker::open(std::string& why) {
    why = "this daylit was built without OpenGL (DAYLIT_GL=OFF)";
    return nullptr;
}

}  // namespace daylit

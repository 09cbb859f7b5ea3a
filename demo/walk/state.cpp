#include "demo/walk/state.h"

#include <cmath>

namespace daylit {

double wrapped_hour(double hour) {
    const double wrapped = std::fmod(hour, 24.0);
    // A tiny negative number plus 24 is 24 itself.
    return wrapped < 0 ? std::fmod(wrapped + 24.0, 24.0) : wrapped;
}

}  // namespace daylit

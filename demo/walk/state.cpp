#include "demo/walk/state.h"

#include <cmath>
#include <cstdio>

namespace daylit {

double wrapped_hour(double hour) {
    const double wrapped = std::fmod(hour, 24.0);
    // A tiny negative number plus 24 is 24 itself.
    return wrapped < 0 ? std::fmod(wrapped + 24.0, 24.0) : wrapped;
}

std::string clock_text(double hour) {
    const int minutes = int(std::lround(wrapped_hour(hour) * 60)) % (24 * 60);
    char text[16];
    std::snprintf(text, sizeof text, "%02d:%02d", minutes / 60, minutes % 60);
    return text;
}

}  // namespace daylit

#pragma once
// How long work reports back and is stopped; libraries print nothing themselves.
#include <functional>

namespace daylit {

/// Called from time to time, from one thread at a time, with the share done, 0 to 1. Returning false stops the work:
/// it throws Interrupted and leaves nothing half-written.
using Progress = std::function<bool(double done)>;
struct Interrupted {};

}  // namespace daylit

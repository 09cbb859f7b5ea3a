#pragma once
// Progress on stderr: a bar with the time left on a terminal, plain lines otherwise; Ctrl-C stops cleanly.
#include <stdexcept>
#include <string>

#include "engine/base/progress.h"

namespace daylit {

/// The first Ctrl-C makes every Progress made here return false; the second one kills the process as usual.
Progress make_progress(const std::string& what);

/// True once Ctrl-C was pressed after the first make_progress().
bool interrupted();

/// Work was stopped and left something to go on from, which what() says; exits like Interrupted.
struct Stopped : std::runtime_error {
    using std::runtime_error::runtime_error;
};

}  // namespace daylit

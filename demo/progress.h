#pragma once
// Progress on stderr: a bar with the time left on a terminal, plain lines otherwise; Ctrl-C stops cleanly.
#include <string>

#include "engine/base/progress.h"

namespace daylit {

/// The first Ctrl-C makes every Progress made here return false; the second one kills the process as usual.
Progress make_progress(const std::string& what);

/// True once Ctrl-C was pressed after the first make_progress().
bool interrupted();

}  // namespace daylit

#pragma once
// Where a command writes: checked before the long work rather than after it.
#include <initializer_list>
#include <string>

namespace daylit {

/// throws Error when the extension is none of these (with their dots) or the folder cannot be written to.
void check_output(const std::string& path, std::initializer_list<const char*> extensions);

}  // namespace daylit

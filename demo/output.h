#pragma once
// Where a command writes: checked before the long work rather than after it.
#include <initializer_list>
#include <string>

namespace daylit {

/// throws Error when the extension is none of these (with their dots) or the folder cannot be written to.
void check_output(const std::string& path, std::initializer_list<const char*> extensions);

/// throws Error when the output is one of these files, which the command reads. An input that is not there is none.
void check_apart(const std::string& output, std::initializer_list<std::string> inputs);

}  // namespace daylit

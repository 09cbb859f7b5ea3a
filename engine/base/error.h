#pragma once
// The one exception for bad files and bad users. Programmer errors are asserts.
#include <stdexcept>
#include <string>

namespace daylit {

/// A file or a user is wrong. what() is one line: the file (or option), the place in it, and the way out.
/// main() prints it on stderr and exits with status 1.
class Error : public std::runtime_error {
  public:
    /// subject   the file or option at fault, e.g. "hall.glb" or "--hour"
    /// message   what is wrong, where, and what to do about it; no newline
    Error(const std::string& subject, const std::string& message)
        : std::runtime_error(subject + ": " + message) {}
    explicit Error(const std::string& message) : std::runtime_error(message) {}
};

/// Wrong usage of the command line; exit status 2.
class UsageError : public Error {
  public:
    using Error::Error;
};

}  // namespace daylit

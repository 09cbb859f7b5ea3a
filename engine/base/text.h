#pragma once
// Other people's words in our messages.
#include <string>

namespace daylit {

/// One line of at most 400 bytes without control characters: names in files and messages of libraries may hold
/// anything.
inline std::string one_line(std::string text) {
    constexpr std::size_t kLongest = 400;
    for (char& c : text)
        if (static_cast<unsigned char>(c) < ' ' || c == 127) c = ' ';
    while (!text.empty() && text.back() == ' ') text.pop_back();
    return text.size() > kLongest ? text.substr(0, kLongest) + "..." : text;
}

}  // namespace daylit

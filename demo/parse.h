#pragma once
// The small grammars of option values. Bad syntax throws UsageError (exit 2), a value out of range Error (exit 1);
// both name the option.
#include <string>
#include <vector>

#include "engine/scene/day.h"

namespace daylit {

double parse_number(const std::string& option, const std::string& text);
double parse_number(const std::string& option, const std::string& text, double min, double max);
/// Of a number that is read already; refuses NaN too.
void check_range(const std::string& option, double value, double min, double max);
double parse_hour(const std::string& option, const std::string& text);  // "7.5" or "07:30", in [0,24)
std::string clock_text(double hour);                                 // "07:30", wrapped to a day
double parse_duration_hours(const std::string& option, const std::string& text);  // "5m", "90s", "1h", "0.5" (hours)
Vec3 parse_vec3(const std::string& option, const std::string& text);             // "x,y,z"
Vec3 parse_place(const std::string& option, const std::string& text);            // the same, where a scene can reach
std::vector<std::string> split(const std::string& text, char separator);         // "a,b" to a and b
Rgb parse_rgb(const std::string& option, const std::string& text);               // "v" or "r,g,b", not negative
Date parse_date(const std::string& text);                                        // YYYY-MM-DD

struct Size {
    int width = 0, height = 0;
};
Size parse_size(const std::string& text);  // WxH, each 1 to 16384, at most 2^27 pixels

}  // namespace daylit

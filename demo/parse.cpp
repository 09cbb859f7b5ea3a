#include "demo/parse.h"

#include <charconv>
#include <cmath>
#include <cstdio>
#include <vector>

#include "engine/base/error.h"
#include "engine/base/image.h"
#include "engine/scene/gltf.h"

namespace daylit {
namespace {

std::string plain(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%g", value);
    return text;
}

int parse_int(const std::string& option, const std::string& text) {
    int value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size()) {
        throw UsageError(option, "'" + text + "' is not a whole number");
    }
    return value;
}

int days_in_month(int year, int month) {
    constexpr int kDays[] = {31, 28, 31, 30, 31, 30, 31, 31, 30, 31, 30, 31};
    const bool leap = (year % 4 == 0 && year % 100 != 0) || year % 400 == 0;
    return month == 2 && leap ? 29 : kDays[month - 1];
}

}  // namespace

std::vector<std::string> split(const std::string& text, char separator) {
    std::vector<std::string> parts(1);
    for (const char c : text) {
        if (c == separator) {
            parts.emplace_back();
        } else {
            parts.back() += c;
        }
    }
    return parts;
}

std::string clock_text(double hour) {
    constexpr long kMinutes = 24 * 60;
    const long minutes = (std::lround(hour * 60.0) % kMinutes + kMinutes) % kMinutes;
    char text[16];
    std::snprintf(text, sizeof text, "%02ld:%02ld", minutes / 60, minutes % 60);
    return text;
}

double parse_number(const std::string& option, const std::string& text) {
    double value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size() || text.empty()) {
        throw UsageError(option, "'" + text + "' is not a number");
    }
    if (!std::isfinite(value)) throw Error(option, "'" + text + "' is not a finite number");
    return value;
}

double parse_number(const std::string& option, const std::string& text, double min, double max) {
    const double value = parse_number(option, text);
    if (value < min || value > max) {
        throw Error(option, text + " is out of range; give " + plain(min) + " to " + plain(max));
    }
    return value;
}

void check_range(const std::string& option, double value, double min, double max) {
    if (value >= min && value <= max) return;
    throw Error(option, plain(value) + " is out of range; give " + plain(min) + " to " + plain(max));
}

double parse_hour(const std::string& option, const std::string& text) {
    const std::vector<std::string> parts = split(text, ':');
    double hour = 0;
    if (parts.size() == 2) {
        const int minutes = parse_int(option, parts[1]);
        if (minutes < 0 || minutes > 59) throw Error(option, "'" + text + "': minutes run from 00 to 59");
        hour = parse_int(option, parts[0]) + minutes / 60.0;
    } else if (parts.size() == 1) {
        hour = parse_number(option, text);
    } else {
        throw UsageError(option, "'" + text + "' is not an hour; give 7.5 or 07:30");
    }
    // Minutes count on from the hour, so -0:30 would be half past midnight.
    if (hour < 0 || hour >= 24 || text.front() == '-')
        throw Error(option, text + " is out of range; hours run from 0 to below 24");
    return hour;
}

double parse_duration_hours(const std::string& option, const std::string& text) {
    double hours_per_unit = 1.0;
    std::string number = text;
    if (!text.empty() && std::string("hms").find(text.back()) != std::string::npos) {
        number.pop_back();
        hours_per_unit = text.back() == 'h' ? 1.0 : text.back() == 'm' ? 1.0 / 60 : 1.0 / 3600;
    }
    const double hours = parse_number(option, number) * hours_per_unit;
    if (!(hours >= 1.0 / 3600 && hours <= 24)) throw Error(option, text + " is out of range; give 1s to 24h");
    return hours;
}

Vec3 parse_vec3(const std::string& option, const std::string& text) {
    const std::vector<std::string> parts = split(text, ',');
    if (parts.size() != 3) throw UsageError(option, "'" + text + "' is not x,y,z");
    const auto number = [&](int i) { return float(parse_number(option, parts[std::size_t(i)], -1e30, 1e30)); };
    return {number(0), number(1), number(2)};
}

Vec3 parse_place(const std::string& option, const std::string& text) {
    const Vec3 place = parse_vec3(option, text);
    for (int axis = 0; axis < 3; ++axis)
        if (!(std::abs(place[axis]) <= kMaxCoordinate))
            throw Error(option, text + " lies more than 1e8 m from the origin");
    return place;
}

Rgb parse_rgb(const std::string& option, const std::string& text) {
    const bool grey = text.find(',') == std::string::npos;
    const Rgb rgb = grey ? Rgb(float(parse_number(option, text))) : parse_vec3(option, text);
    for (int c = 0; c < 3; ++c)
        if (!(rgb[c] >= 0.0f && rgb[c] <= 1e12f)) throw Error(option, text + " is out of range; light is 0 to 1e+12");
    return rgb;
}

Date parse_date(const std::string& text) {
    const std::vector<std::string> parts = split(text, '-');
    if (parts.size() != 3) throw UsageError("--date", "'" + text + "' is not YYYY-MM-DD");
    const Date date{parse_int("--date", parts[0]), parse_int("--date", parts[1]), parse_int("--date", parts[2])};
    if (date.year < 1 || date.year > 6000 || date.month < 1 || date.month > 12 || date.day < 1 ||
        date.day > days_in_month(date.year, date.month)) {
        throw Error("--date", "there is no day " + text);
    }
    return date;
}

Size parse_size(const std::string& text) {
    const std::vector<std::string> parts = split(text, 'x');
    if (parts.size() != 2) throw UsageError("--size", "'" + text + "' is not WxH");
    const Size size{parse_int("--size", parts[0]), parse_int("--size", parts[1])};
    if (size.width < 1 || size.height < 1 || size.width > kMaxImageSide || size.height > kMaxImageSide ||
        std::size_t(size.width) * std::size_t(size.height) > kMaxImagePixels) {
        throw Error("--size", text + " is out of range; each side takes 1 to 16384, 134 million pixels in all");
    }
    return size;
}

}  // namespace daylit

#include "engine/scene/environment.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/base/error.h"

namespace daylit {
namespace {

constexpr float kLargestHalf = 65504.0f;

float largest_finite(const Image& image) {
    float largest = 0.0f;
    for (const Rgb& pixel : image.pixels) {
        for (int c = 0; c < 3; ++c) {
            if (std::isfinite(pixel[c])) largest = std::max(largest, pixel[c]);
        }
    }
    return largest;
}

bool looks_latlong(const Image& image) {
    if (image.width == 1 && image.height == 1) return true;
    const int wide = image.width - 2 * image.height;
    return image.width >= 2 && std::abs(wide) <= 2;
}

}  // namespace

Rgb disc_radiance(const Sun& sun) {
    const double sine = std::sin(kSunRadius);
    return sun.irradiance * float(1.0 / (kPi * sine * sine));
}

Vec2 latlong_from_direction(const Vec3& direction) {
    const double u = 0.5 + std::atan2(double(direction.x), -double(direction.z)) / (2.0 * kPi);
    return Vec2(u, std::acos(std::clamp(double(direction.y), -1.0, 1.0)) / kPi);
}

Vec3 direction_from_latlong(const Vec2& uv) {
    const double bearing = (uv.x - 0.5) * 2.0 * kPi, zenith = uv.y * kPi;
    return Vec3(std::sin(bearing) * std::sin(zenith), std::cos(zenith), -std::cos(bearing) * std::sin(zenith));
}

bool Environment::black() const {
    return std::all_of(map.pixels.begin(), map.pixels.end(), [](const Rgb& p) { return p == Rgb(0.0f); });
}

Rgb Environment::radiance(const Vec3& direction) const {
    if (map.empty()) return Rgb(0.0f);
    if (constant()) return map.pixels[0];
    const Vec2 uv = latlong_from_direction(direction);
    const float x = uv.x * float(map.width) - 0.5f;
    const float y = std::clamp(uv.y * float(map.height) - 0.5f, 0.0f, float(map.height - 1));
    const int left = int(std::floor(x)), top = std::min(int(y), map.height - 1);
    const int bottom = std::min(top + 1, map.height - 1);
    const int x0 = (left % map.width + map.width) % map.width, x1 = (x0 + 1) % map.width;
    const float fx = x - float(left), fy = y - float(top);
    return glm::mix(glm::mix(map.at(x0, top), map.at(x1, top), fx), glm::mix(map.at(x0, bottom), map.at(x1, bottom), fx),
                    fy);
}

Environment usable_environment(Image image, const std::string& name) {
    if (image.empty()) throw Error(name, "the environment has no pixels");
    if (!looks_latlong(image)) {
        throw Error(name, "is " + std::to_string(image.width) + " x " + std::to_string(image.height) +
                              ", not a latitude-longitude map, which is twice as wide as high; convert it first");
    }
    const float for_infinity = std::clamp(largest_finite(image), kLargestHalf, kBrightestEnvironment);
    for (Rgb& pixel : image.pixels) {
        for (int c = 0; c < 3; ++c) {
            float& value = pixel[c];
            if (!(value > 0.0f)) {
                value = 0.0f;  // NaN too
            } else if (std::isinf(value)) {
                value = for_infinity;
            } else {
                value = std::min(value, kBrightestEnvironment);
            }
        }
    }
    return Environment{std::move(image)};
}

Rgb horizontal_irradiance(const Environment& sky) {
    const Image& map = sky.map;
    if (sky.constant()) return map.pixels[0] * float(kPi);
    glm::dvec3 sum(0.0);
    for (int y = 0; y < map.height; ++y) {
        const double above = y * kPi / map.height, below = std::min((y + 1) * kPi / map.height, 0.5 * kPi);
        if (above >= below) break;
        // Of cos sin over the row's zenith angles.
        const double weight = 0.5 * (std::sin(below) * std::sin(below) - std::sin(above) * std::sin(above));
        glm::dvec3 row(0.0);
        for (int x = 0; x < map.width; ++x) row += glm::dvec3(map.at(x, y));
        sum += row * weight;
    }
    return Rgb(sum * (2.0 * kPi / map.width));
}

}  // namespace daylit

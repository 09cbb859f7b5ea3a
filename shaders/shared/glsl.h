// Lets a file of pure functions compile as C++ (with GLM) and as GLSL 4.5. GLSL programs include it for the macros'
// sake only. In C++ everything shared lives in daylit::glsl.
#ifdef __cplusplus
#pragma once
#include <cmath>
#include <glm/glm.hpp>
namespace daylit::glsl {
using glm::vec2, glm::vec3, glm::vec4, glm::uvec4, glm::mat3, glm::mat4, glm::uint;
using glm::dot, glm::cross, glm::normalize, glm::length, glm::reflect, glm::mix, glm::clamp, glm::min, glm::max, glm::abs, glm::floor, glm::step;
using std::pow, std::sqrt, std::exp, std::log, std::sin, std::cos, std::acos;
}  // namespace daylit::glsl
#define SHARED_BEGIN namespace daylit::glsl {
#define SHARED_END }
#define SHARED_FN inline
#else
#ifndef SHADERS_SHARED_GLSL_H
#define SHADERS_SHARED_GLSL_H
#define SHARED_BEGIN
#define SHARED_END
#define SHARED_FN
#endif
#endif

#pragma once
// One maker a platform, for context.cpp only. Each returns a context that is not yet current, or throws Error.
#include "engine/gl/context.h"

namespace daylit {

std::unique_ptr<GlContext> make_egl_context(const ContextOptions& options);
std::unique_ptr<GlContext> make_osmesa_context(const ContextOptions& options);
std::unique_ptr<GlContext> make_glfw_context(const ContextOptions& options);

}  // namespace daylit

#include "engine/gl/context.h"

#include <glad/gl.h>

#include <stdexcept>
#include <vector>

#include "engine/base/error.h"
#include "engine/gl/platforms.h"

namespace daylit {
namespace {

GlContext* current_context = nullptr;
// The functions of one platform serve all of its contexts, so they are looked up again only when the platform changes.
std::optional<ContextKind> loaded_kind;
std::vector<std::string> debug_messages;

using Loader = std::function<void*(const char*)>;

GLADapiproc call_loader(void* loader, const char* name) {
    return reinterpret_cast<GLADapiproc>((*static_cast<const Loader*>(loader))(name));
}

void load_functions(const Loader& loader) {
    const int version = gladLoadGLUserPtr(&call_loader, const_cast<Loader*>(&loader));
    if (version == 0) throw Error("OpenGL", "no functions could be loaded; is a context current?");
    if (version < GLAD_MAKE_VERSION(4, 5)) {
        throw Error("OpenGL", "version " + std::to_string(GLAD_VERSION_MAJOR(version)) + "." +
                                  std::to_string(GLAD_VERSION_MINOR(version)) +
                                  " is too old; daylit needs 4.5 core (Mesa's llvmpipe has it on any machine)");
    }
}

// The shader compiler's complaints are left to Program, which knows files and lines.
void GLAD_API_PTR on_debug_message(GLenum source, GLenum type, GLuint, GLenum, GLsizei, const GLchar* message,
                                   const void*) {
    const bool wrong = type == GL_DEBUG_TYPE_ERROR || type == GL_DEBUG_TYPE_UNDEFINED_BEHAVIOR;
    if (wrong && source != GL_DEBUG_SOURCE_SHADER_COMPILER) debug_messages.emplace_back(message);
}

void gather_debug_messages() {
    glEnable(GL_DEBUG_OUTPUT);
    glEnable(GL_DEBUG_OUTPUT_SYNCHRONOUS);
    glDebugMessageCallback(&on_debug_message, nullptr);
}

std::unique_ptr<GlContext> make_platform_context(ContextKind kind, const ContextOptions& options) {
    switch (kind) {
        case ContextKind::Egl:
            return make_egl_context(options);
        case ContextKind::OsMesa:
            return make_osmesa_context(options);
        case ContextKind::Glfw:
            return make_glfw_context(options);
    }
    throw std::logic_error("context kind out of range");
}

}  // namespace

ContextKind parse_context_kind(const std::string& text) {
    for (const ContextKind kind : {ContextKind::Egl, ContextKind::OsMesa, ContextKind::Glfw}) {
        if (text == name(kind)) return kind;
    }
    throw UsageError("--context", "unknown context '" + text + "'; it is one of egl, osmesa, glfw");
}

const char* name(ContextKind kind) {
    switch (kind) {
        case ContextKind::Egl:
            return "egl";
        case ContextKind::OsMesa:
            return "osmesa";
        case ContextKind::Glfw:
            return "glfw";
    }
    return "";
}

void GlContext::make_current() {
    // GLX, EGL and OSMesa each refuse, or silently mix up, a thread that still has another platform's context.
    if (current_context && current_context != this) current_context->unbind();
    current_context = nullptr;
    bind();
    current_context = this;
    if (loaded_kind == kind()) return;
    loaded_kind.reset();
    load_functions([this](const char* function_name) { return function(function_name); });
    loaded_kind = kind();
}

void GlContext::leave() noexcept {
    if (current_context != this) return;
    unbind();
    current_context = nullptr;
}

std::string GlContext::description() const {
    const auto text = [](GLenum what) {
        const auto* s = reinterpret_cast<const char*>(glGetString(what));
        return std::string(s ? s : "unknown");
    };
    return text(GL_RENDERER) + ", OpenGL " + text(GL_VERSION);
}

std::unique_ptr<GlContext> make_context(ContextKind kind, const ContextOptions& options) {
    std::unique_ptr<GlContext> context = make_platform_context(kind, options);
    context->make_current();
    if (options.debug) gather_debug_messages();
    return context;
}

std::unique_ptr<GlContext> make_any_context(const ContextOptions& options) {
    std::string reasons;
    for (const ContextKind kind : {ContextKind::Egl, ContextKind::OsMesa, ContextKind::Glfw}) {
        try {
            return make_context(kind, options);
        } catch (const Error& error) {
            reasons += std::string(reasons.empty() ? "" : "; ") + error.what();
        }
    }
    throw Error("OpenGL", "no context could be made (" + reasons + ")");
}

void load_gl(const std::function<void*(const char*)>& get_proc_address) {
    loaded_kind.reset();
    load_functions(get_proc_address);
}

void check_gl() {
    if (debug_messages.empty()) return;
    std::string all;
    for (const std::string& message : debug_messages) all += (all.empty() ? "OpenGL: " : "\n") + message;
    debug_messages.clear();
    throw std::logic_error(all);
}

}  // namespace daylit

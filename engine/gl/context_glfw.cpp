// GLFW: a window, shown or hidden, on the display there is.
#include <GLFW/glfw3.h>

#include "engine/base/error.h"
#include "engine/gl/platforms.h"

namespace daylit {
namespace {

std::string glfw_error_text() {
    const char* text = nullptr;
    glfwGetError(&text);
    return text ? text : "unknown reason";
}

/// glfwInit once a process, glfwTerminate at its end. Never in between: terminating unloads the driver, and Mesa's GLX
/// does not survive being loaded a second time.
class GlfwLibrary {
  public:
    static void need() { static const GlfwLibrary library; }

  private:
    GlfwLibrary() {
        if (!glfwInit()) {
            throw Error("GLFW", "no display to open a window on (" + glfw_error_text() + "); EGL and OSMesa need none");
        }
    }
    ~GlfwLibrary() { glfwTerminate(); }
    GlfwLibrary(const GlfwLibrary&) = delete;
    GlfwLibrary& operator=(const GlfwLibrary&) = delete;
};

class GlfwContext : public GlContext {
  public:
    explicit GlfwContext(const ContextOptions& options) {
        GlfwLibrary::need();
        glfwDefaultWindowHints();
        glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 4);
        glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 5);
        glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
        glfwWindowHint(GLFW_OPENGL_FORWARD_COMPAT, GLFW_TRUE);
        glfwWindowHint(GLFW_OPENGL_DEBUG_CONTEXT, options.debug ? GLFW_TRUE : GLFW_FALSE);
        glfwWindowHint(GLFW_VISIBLE, options.visible ? GLFW_TRUE : GLFW_FALSE);
        glfwWindowHint(GLFW_DEPTH_BITS, 0);  // depth lives in the renderer's own targets
        glfwWindowHint(GLFW_STENCIL_BITS, 0);
        window_ = glfwCreateWindow(options.width, options.height, options.title.c_str(), nullptr, nullptr);
        if (!window_) {
            throw Error("GLFW",
                        "no window with OpenGL 4.5 core (" + glfw_error_text() + "); try --context egl or osmesa");
        }
    }
    ~GlfwContext() override {
        leave();
        glfwDestroyWindow(window_);
    }
    GLFWwindow* window() override { return window_; }

  protected:
    ContextKind kind() const override { return ContextKind::Glfw; }
    void bind() override {
        glfwMakeContextCurrent(window_);
        if (glfwGetCurrentContext() != window_) {
            throw Error("GLFW", "its context cannot be made current (" + glfw_error_text() + ")");
        }
    }
    void unbind() noexcept override { glfwMakeContextCurrent(nullptr); }
    void* function(const char* name) const override { return reinterpret_cast<void*>(glfwGetProcAddress(name)); }

  private:
    GLFWwindow* window_ = nullptr;
};

}  // namespace

std::unique_ptr<GlContext> make_glfw_context(const ContextOptions& options) {
    return std::make_unique<GlfwContext>(options);
}

}  // namespace daylit

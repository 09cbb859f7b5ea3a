#pragma once
// OpenGL 4.5 core contexts by GLFW, EGL (surfaceless) and OSMesa behind one small interface.
#include <functional>
#include <memory>
#include <optional>
#include <string>

struct GLFWwindow;

namespace daylit {

enum class ContextKind { Egl, OsMesa, Glfw };
ContextKind parse_context_kind(const std::string& name);  // "egl", "osmesa", "glfw"; else UsageError
const char* name(ContextKind kind);

/// A current context with its functions loaded. Every GL object made in it must die before it does.
/// Off-screen drawing goes to framebuffer objects; a GLFW context also has its window's framebuffer 0.
/// Several may live in one process, of one kind or of several; one at a time is current, all on one thread.
class GlContext {
  public:
    GlContext() = default;
    GlContext(const GlContext&) = delete;
    GlContext& operator=(const GlContext&) = delete;
    virtual ~GlContext() = default;
    /// Makes it current in place of whichever daylit context was, and points the loaded functions at its driver.
    void make_current();
    /// Renderer and version as the driver says them. The context must be current.
    std::string description() const;
    /// GLFW only; null otherwise.
    virtual GLFWwindow* window() { return nullptr; }

  protected:
    virtual ContextKind kind() const = 0;
    virtual void bind() = 0;             // throws Error when the platform refuses
    virtual void unbind() noexcept = 0;  // leaves the thread without a context of this platform
    virtual void* function(const char* name) const = 0;
    /// For destructors: unbinds when current.
    void leave() noexcept;
};

struct ContextOptions {
    bool debug = false;  // debug output: errors and undefined behaviour become exceptions at the next check_gl()
    int width = 64, height = 64;
    bool visible = false;  // GLFW: show the window
    std::string title = "daylit";
};

/// throws Error when the platform cannot give such a context (no display for GLFW, no driver, version below 4.5).
std::unique_ptr<GlContext> make_context(ContextKind kind, const ContextOptions& options = {});

/// The first that works of EGL, OSMesa, GLFW.
std::unique_ptr<GlContext> make_any_context(const ContextOptions& options = {});

/// For hosts with a context of their own: loads the functions daylit needs through their loader.
void load_gl(const std::function<void*(const char*)>& get_proc_address);

/// Throws std::logic_error with the driver's messages gathered since the last call, when debug output reported an
/// error; does nothing in a context without debug output.
void check_gl();

}  // namespace daylit

// EGL without any surface: Mesa's surfaceless platform, or the first device that will do.
#include <EGL/egl.h>
#include <EGL/eglext.h>

#include <array>
#include <sstream>
#include <vector>

#include "engine/base/error.h"
#include "engine/gl/library.h"
#include "engine/gl/platforms.h"

namespace daylit {
namespace {

struct Egl {
    Library library{"EGL", {"libEGL.so.1", "libEGL.so"}};
    decltype(eglGetProcAddress)* get_proc_address;
    decltype(eglGetError)* get_error;
    decltype(eglQueryString)* query_string;
    decltype(eglInitialize)* initialize;
    decltype(eglBindAPI)* bind_api;
    decltype(eglChooseConfig)* choose_config;
    decltype(eglCreateContext)* create_context;
    decltype(eglDestroyContext)* destroy_context;
    decltype(eglMakeCurrent)* make_current;

    Egl() {
        library.get(get_proc_address, "eglGetProcAddress");
        library.get(get_error, "eglGetError");
        library.get(query_string, "eglQueryString");
        library.get(initialize, "eglInitialize");
        library.get(bind_api, "eglBindAPI");
        library.get(choose_config, "eglChooseConfig");
        library.get(create_context, "eglCreateContext");
        library.get(destroy_context, "eglDestroyContext");
        library.get(make_current, "eglMakeCurrent");
    }
    bool client_extension(const std::string& wanted) const {
        const char* all = query_string(EGL_NO_DISPLAY, EGL_EXTENSIONS);
        std::istringstream words(all ? all : "");
        for (std::string word; words >> word;) {
            if (word == wanted) return true;
        }
        return false;
    }
    template <typename Function>
    Function extension_function(const char* name) const {
        return reinterpret_cast<Function>(get_proc_address(name));
    }
};

const Egl& egl() {
    static const Egl loaded;
    return loaded;
}

std::string egl_error_text() {
    std::ostringstream text;
    text << "EGL error 0x" << std::hex << egl().get_error();
    return text.str();
}

std::vector<EGLDisplay> device_displays(PFNEGLGETPLATFORMDISPLAYEXTPROC get_display) {
    const auto query_devices = egl().extension_function<PFNEGLQUERYDEVICESEXTPROC>("eglQueryDevicesEXT");
    if (!query_devices) return {};
    std::array<EGLDeviceEXT, 16> devices;
    EGLint count = 0;
    if (!query_devices(EGLint(devices.size()), devices.data(), &count)) return {};
    std::vector<EGLDisplay> displays;
    for (EGLint i = 0; i < count; ++i) {
        displays.push_back(get_display(EGL_PLATFORM_DEVICE_EXT, devices[std::size_t(i)], nullptr));
    }
    return displays;
}

std::vector<EGLDisplay> candidate_displays() {
    const auto get_display = egl().extension_function<PFNEGLGETPLATFORMDISPLAYEXTPROC>("eglGetPlatformDisplayEXT");
    if (!get_display) return {};
    std::vector<EGLDisplay> displays;
    if (egl().client_extension("EGL_MESA_platform_surfaceless")) {
        displays.push_back(get_display(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr));
    }
    if (egl().client_extension("EGL_EXT_platform_device")) {
        const std::vector<EGLDisplay> devices = device_displays(get_display);
        displays.insert(displays.end(), devices.begin(), devices.end());
    }
    return displays;
}

EGLContext create_context(EGLDisplay display, bool debug) {
    const EGLint config_wanted[] = {EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT, EGL_SURFACE_TYPE, 0, EGL_NONE};
    EGLConfig config = nullptr;
    EGLint count = 0;
    if (!egl().choose_config(display, config_wanted, &config, 1, &count) || count == 0) config = EGL_NO_CONFIG_KHR;
    const EGLint wanted[] = {EGL_CONTEXT_MAJOR_VERSION,
                             4,
                             EGL_CONTEXT_MINOR_VERSION,
                             5,
                             EGL_CONTEXT_OPENGL_PROFILE_MASK,
                             EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                             EGL_CONTEXT_OPENGL_DEBUG,
                             debug ? EGL_TRUE : EGL_FALSE,
                             EGL_NONE};
    return egl().create_context(display, config, EGL_NO_CONTEXT, wanted);
}

class EglContext : public GlContext {
  public:
    // Displays are shared by all contexts of the process and stay initialised until it ends.
    explicit EglContext(const ContextOptions& options) {
        std::string reason = "it has neither EGL_MESA_platform_surfaceless nor EGL_EXT_platform_device";
        for (const EGLDisplay display : candidate_displays()) {
            if (display == EGL_NO_DISPLAY || !egl().initialize(display, nullptr, nullptr) ||
                !egl().bind_api(EGL_OPENGL_API)) {
                reason = egl_error_text();
                continue;
            }
            context_ = create_context(display, options.debug);
            display_ = display;
            if (context_ != EGL_NO_CONTEXT) return;
            reason = egl_error_text();
        }
        throw Error("EGL", "no OpenGL 4.5 core context without a surface: " + reason + "; try --context osmesa");
    }
    ~EglContext() override {
        leave();
        egl().destroy_context(display_, context_);
    }

  protected:
    ContextKind kind() const override { return ContextKind::Egl; }
    void bind() override {
        egl().bind_api(EGL_OPENGL_API);
        if (!egl().make_current(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_)) {
            throw Error("EGL", "its context cannot be made current: " + egl_error_text());
        }
    }
    void unbind() noexcept override { egl().make_current(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT); }
    void* function(const char* name) const override { return reinterpret_cast<void*>(egl().get_proc_address(name)); }

  private:
    EGLDisplay display_ = EGL_NO_DISPLAY;
    EGLContext context_ = EGL_NO_CONTEXT;
};

}  // namespace

std::unique_ptr<GlContext> make_egl_context(const ContextOptions& options) {
    return std::make_unique<EglContext>(options);
}

}  // namespace daylit

// OSMesa: Mesa's software rasteriser with no window system at all.
#include <GL/osmesa.h>

#include <array>

#include "engine/base/error.h"
#include "engine/gl/library.h"
#include "engine/gl/platforms.h"

namespace daylit {
namespace {

struct OsMesa {
    Library library{"OSMesa", {"libOSMesa.so.8", "libOSMesa.so.6", "libOSMesa.so"}};
    decltype(OSMesaCreateContextAttribs)* create_context;
    decltype(OSMesaDestroyContext)* destroy_context;
    decltype(OSMesaMakeCurrent)* make_current;
    decltype(OSMesaGetProcAddress)* get_proc_address;

    OsMesa() {
        library.get(create_context, "OSMesaCreateContextAttribs");
        library.get(destroy_context, "OSMesaDestroyContext");
        library.get(make_current, "OSMesaMakeCurrent");
        library.get(get_proc_address, "OSMesaGetProcAddress");
    }
};

const OsMesa& osmesa() {
    static const OsMesa loaded;
    return loaded;
}

// Debug output needs no flag here: Mesa reports in any context once GL_DEBUG_OUTPUT is enabled.
class OsMesaContext : public GlContext {
  public:
    OsMesaContext() {
        const int wanted[] = {OSMESA_FORMAT,
                              OSMESA_RGBA,
                              OSMESA_PROFILE,
                              OSMESA_CORE_PROFILE,
                              OSMESA_CONTEXT_MAJOR_VERSION,
                              4,
                              OSMESA_CONTEXT_MINOR_VERSION,
                              5,
                              0};
        context_ = osmesa().create_context(wanted, nullptr);
        if (!context_) throw Error("OSMesa", "it refuses an OpenGL 4.5 core context; Mesa 17 or newer is needed");
    }
    ~OsMesaContext() override {
        leave();
        osmesa().destroy_context(context_);
    }

  protected:
    ContextKind kind() const override { return ContextKind::OsMesa; }
    void bind() override {
        if (!osmesa().make_current(context_, pixel_.data(), GL_UNSIGNED_BYTE, 1, 1)) {
            throw Error("OSMesa", "its context cannot be made current");
        }
    }
    void unbind() noexcept override { osmesa().make_current(nullptr, nullptr, 0, 0, 0); }
    void* function(const char* name) const override { return reinterpret_cast<void*>(osmesa().get_proc_address(name)); }

  private:
    OSMesaContext context_ = nullptr;
    std::array<unsigned char, 4> pixel_ = {};  // framebuffer 0, which nobody draws to
};

}  // namespace

std::unique_ptr<GlContext> make_osmesa_context(const ContextOptions&) {
    return std::make_unique<OsMesaContext>();
}

}  // namespace daylit

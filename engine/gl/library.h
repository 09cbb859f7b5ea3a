#pragma once
// Opens EGL and OSMesa when they are asked for, so that a host that uses neither need not have them, and so that
// OSMesa's own gl* symbols stay out of everybody else's sight.
#include <dlfcn.h>

#include <initializer_list>
#include <string>

#include "engine/base/error.h"

namespace daylit {

class Library {
  public:
    /// The first of these that can be opened. Never closed: drivers leave threads and exit handlers behind.
    Library(const char* platform, std::initializer_list<const char*> names) : platform_(platform) {
        for (const char* name : names) {
            handle_ = dlopen(name, RTLD_NOW | RTLD_LOCAL);
            if (handle_) return;
        }
        throw Error(platform_, std::string(*names.begin()) +
                                   " cannot be opened; install Mesa's package for it or choose another --context");
    }
    template <typename Function>
    void get(Function*& function, const char* name) const {
        function = reinterpret_cast<Function*>(dlsym(handle_, name));
        if (!function) throw Error(platform_, std::string("its library has no ") + name + "; it is too old");
    }

  private:
    std::string platform_;
    void* handle_ = nullptr;
};

}  // namespace daylit

#pragma once
// The walk's window: GLFW's events turned into wishes of WalkState, Dear ImGui begun and ended around the panel.
#include <memory>
#include <string>

#include "demo/walk/state.h"
#include "demo/walk/walker.h"
#include "engine/gl/context.h"

namespace daylit {

class WalkWindow {
  public:
    /// throws Error when there is no display.
    WalkWindow(int width, int height, const std::string& title, WalkState& state);
    ~WalkWindow();
    WalkWindow(const WalkWindow&) = delete;
    WalkWindow& operator=(const WalkWindow&) = delete;

    /// Handles the events there are; when there are none, waits up to `seconds` for some.
    void poll(double seconds);
    /// Keys held down now, and the gaze turned by the mouse since the last call.
    Steering steering(float seconds);

    /// Framebuffer size in pixels; 0x0 while minimised.
    void size(int& width, int& height) const;
    bool mouse_captured() const { return captured_; }
    /// True for some frames after any event: the panel needs them to settle.
    bool stirred() const { return frames_to_draw_ > 0; }

    void begin_panel();
    /// Draws the panel over framebuffer 0 and shows the frame.
    void end_panel_and_show();
    void set_title(const std::string& title);

  private:
    static WalkWindow& self(GLFWwindow* window);
    static void on_key(GLFWwindow* window, int key, int scancode, int action, int mods);
    static void on_button(GLFWwindow* window, int button, int action, int mods);
    static void on_cursor(GLFWwindow* window, double x, double y);
    void press(int key, bool shift);
    void capture(bool on);
    bool down(int key) const;
    void stir() { frames_to_draw_ = 4; }

    WalkState& state_;
    std::unique_ptr<GlContext> context_;
    GLFWwindow* window_ = nullptr;
    bool captured_ = false;
    bool clicked_ = false;  // since the last frame
    double cursor_x_ = 0, cursor_y_ = 0;
    int frames_to_draw_ = 4;
    std::string title_;
};

}  // namespace daylit

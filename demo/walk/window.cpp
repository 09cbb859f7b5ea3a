#include "demo/walk/window.h"

#define GLFW_INCLUDE_NONE  // glad brings GL
#include <GLFW/glfw3.h>
#include <glad/gl.h>
#include <imgui.h>

#include <algorithm>
#include <utility>

#include "backends/imgui_impl_glfw.h"
#include "backends/imgui_impl_opengl3.h"
#include "engine/base/error.h"

namespace daylit {
namespace {

constexpr float kMouseTurn = 0.0025f;  // radians a pixel
constexpr float kKeyTurn = 1.6f;       // radians a second

std::unique_ptr<GlContext> open_window(int width, int height, const std::string& title) {
    try {
        return make_context(ContextKind::Glfw, {.width = width, .height = height, .visible = true, .title = title});
    } catch (const Error& error) {
        throw Error("walk", std::string("no window to walk in (") + error.what() +
                                "); 'daylit shot' and 'daylit day' draw without one");
    }
}

}  // namespace

WalkWindow::WalkWindow(int width, int height, const std::string& title, WalkState& state)
    : state_(state), context_(open_window(width, height, title)), window_(context_->window()), title_(title) {
    glfwSwapInterval(1);
    glfwSetWindowUserPointer(window_, this);
    // Dear ImGui calls these before its own.
    glfwSetKeyCallback(window_, &on_key);
    glfwSetMouseButtonCallback(window_, &on_button);
    glfwSetScrollCallback(window_, [](GLFWwindow* w, double, double) { self(w).stir(); });
    glfwSetCharCallback(window_, [](GLFWwindow* w, unsigned) { self(w).stir(); });
    glfwSetCursorPosCallback(window_, &on_cursor);
    glfwSetFramebufferSizeCallback(window_, [](GLFWwindow* w, int, int) { self(w).stir(); });
    glfwSetWindowRefreshCallback(window_, [](GLFWwindow* w) { self(w).stir(); });
    IMGUI_CHECKVERSION();
    ImGui::CreateContext();
    ImGui::GetIO().IniFilename = nullptr;  // leaves no imgui.ini in the working folder
    ImGui::StyleColorsDark();
    ImGui_ImplGlfw_InitForOpenGL(window_, true);
    ImGui_ImplOpenGL3_Init("#version 450 core");
}

WalkWindow::~WalkWindow() {
    ImGui_ImplOpenGL3_Shutdown();
    ImGui_ImplGlfw_Shutdown();
    ImGui::DestroyContext();
}

WalkWindow& WalkWindow::self(GLFWwindow* window) {
    return *static_cast<WalkWindow*>(glfwGetWindowUserPointer(window));
}

void WalkWindow::poll(double seconds) {
    seconds > 0 ? glfwWaitEventsTimeout(seconds) : glfwPollEvents();
    if (glfwWindowShouldClose(window_)) state_.quit = true;
    frames_to_draw_ = std::max(0, frames_to_draw_ - 1);
}

void WalkWindow::on_key(GLFWwindow* window, int key, int, int action, int mods) {
    WalkWindow& me = self(window);
    me.stir();
    if (action == GLFW_RELEASE || ImGui::GetIO().WantTextInput) return;
    const bool repeats = key == GLFW_KEY_LEFT_BRACKET || key == GLFW_KEY_RIGHT_BRACKET;
    if (action == GLFW_PRESS || repeats) me.press(key, (mods & GLFW_MOD_SHIFT) != 0);
}

void WalkWindow::press(int key, bool shift) {
    const double leap = shift ? 1.0 : 1.0 / 6;
    switch (key) {
        case GLFW_KEY_F1:
            state_.help = !state_.help;
            break;
        case GLFW_KEY_F12:
            state_.screenshot = true;
            break;
        case GLFW_KEY_TAB:
            state_.panel = !state_.panel;
            break;
        case GLFW_KEY_SPACE:
            state_.jump = true;
            break;
        case GLFW_KEY_F:
            state_.toggle_flight = true;
            break;
        case GLFW_KEY_P:
            state_.playing = !state_.playing;
            break;
        case GLFW_KEY_R:
            state_.reload_shaders = true;
            break;
        case GLFW_KEY_B:
            state_.add_bookmark = true;
            break;
        case GLFW_KEY_LEFT_BRACKET:
            state_.hour = wrapped_hour(state_.hour - leap);
            break;
        case GLFW_KEY_RIGHT_BRACKET:
            state_.hour = wrapped_hour(state_.hour + leap);
            break;
        case GLFW_KEY_ESCAPE:
            captured_ ? capture(false) : void(state_.quit = true);
            break;
        default:
            if (key >= GLFW_KEY_1 && key <= GLFW_KEY_9) state_.go_to = std::size_t(key - GLFW_KEY_1);
    }
}

void WalkWindow::on_button(GLFWwindow* window, int, int action, int) {
    WalkWindow& me = self(window);
    me.stir();
    // Where the pointer is now, not where a slow frame finds it later.
    double x = 0, y = 0;
    glfwGetCursorPos(window, &x, &y);
    const Vec2 panel = me.state_.panel ? me.state_.panel_size : Vec2(0.0f);
    const bool on_panel = x < double(panel.x) && y < double(panel.y);
    if (action == GLFW_PRESS && !on_panel) me.clicked_ = true;
}

void WalkWindow::on_cursor(GLFWwindow* window, double x, double y) {
    WalkWindow& me = self(window);
    me.stir();
    if (me.captured_) {
        Gaze& gaze = me.state_.gaze;
        gaze.yaw -= float(x - me.cursor_x_) * kMouseTurn;
        gaze.pitch -= float(y - me.cursor_y_) * kMouseTurn;
        gaze.pitch = std::clamp(gaze.pitch, -kSteepestPitch, kSteepestPitch);
    }
    me.cursor_x_ = x;
    me.cursor_y_ = y;
}

void WalkWindow::capture(bool on) {
    captured_ = on;
    glfwSetInputMode(window_, GLFW_CURSOR, on ? GLFW_CURSOR_DISABLED : GLFW_CURSOR_NORMAL);
    glfwGetCursorPos(window_, &cursor_x_, &cursor_y_);
    ImGuiConfigFlags& flags = ImGui::GetIO().ConfigFlags;
    flags = on ? flags | ImGuiConfigFlags_NoMouse : flags & ~ImGuiConfigFlags_NoMouse;
}

bool WalkWindow::down(int key) const {
    return glfwGetKey(window_, key) == GLFW_PRESS;
}

Steering WalkWindow::steering(float seconds) {
    Steering steering;
    if (!ImGui::GetIO().WantTextInput) {
        const auto axis = [this](int plus, int minus) { return float(down(plus)) - float(down(minus)); };
        steering.move =
            Vec3(axis(GLFW_KEY_D, GLFW_KEY_A), axis(GLFW_KEY_SPACE, GLFW_KEY_C), axis(GLFW_KEY_W, GLFW_KEY_S));
        steering.run = down(GLFW_KEY_LEFT_SHIFT) || down(GLFW_KEY_RIGHT_SHIFT);
        Gaze& gaze = state_.gaze;
        gaze.yaw += axis(GLFW_KEY_LEFT, GLFW_KEY_RIGHT) * kKeyTurn * seconds;
        gaze.pitch = std::clamp(gaze.pitch + axis(GLFW_KEY_UP, GLFW_KEY_DOWN) * kKeyTurn * seconds, -kSteepestPitch,
                                kSteepestPitch);
        if (axis(GLFW_KEY_LEFT, GLFW_KEY_RIGHT) != 0 || axis(GLFW_KEY_UP, GLFW_KEY_DOWN) != 0) stir();
    }
    if (steering.move != Vec3(0.0f)) stir();
    steering.jump = std::exchange(state_.jump, false);
    steering.yaw = state_.gaze.yaw;
    steering.pitch = state_.gaze.pitch;
    return steering;
}

void WalkWindow::size(int& width, int& height) const {
    glfwGetFramebufferSize(window_, &width, &height);
}

void WalkWindow::begin_panel() {
    ImGui_ImplOpenGL3_NewFrame();
    ImGui_ImplGlfw_NewFrame();
    ImGui::NewFrame();
    // Dear ImGui knows by now whether the click was meant for a menu or the help page.
    if (std::exchange(clicked_, false) && !captured_ && !ImGui::GetIO().WantCaptureMouse) capture(true);
}

void WalkWindow::end_panel_and_show() {
    ImGui::Render();
    int width = 0, height = 0;
    size(width, height);
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
    glViewport(0, 0, width, height);
    glDisable(GL_FRAMEBUFFER_SRGB);  // Dear ImGui's colours are coded already
    ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
    glfwSwapBuffers(window_);
}

void WalkWindow::set_title(const std::string& title) {
    if (title == title_) return;
    title_ = title;
    glfwSetWindowTitle(window_, title_.c_str());
}

}  // namespace daylit

#include "demo/walk/panel.h"

#include <imgui.h>

#include <algorithm>
#include <cmath>

#include "demo/parse.h"
#include "engine/scene/day.h"

namespace daylit {
namespace {

constexpr float kPanelWidth = 300.0f;

/// Slider over a double; returns true while it is dragged to another value.
bool slider(const char* label, double& value, float min, float max, const char* format) {
    float number = float(value);
    if (!ImGui::SliderFloat(label, &number, min, max, format)) return false;
    value = double(number);
    return true;
}

void draw_time(WalkState& state) {
    ImGui::PushItemWidth(-1);
    const std::string clock = clock_text(state.hour);
    // 23:59 is the end: 24:00 would be 00:00 of the same day.
    if (slider("##hour", state.hour, 0.0f, 23.98f, clock.c_str())) state.playing = false;
    ImGui::PopItemWidth();
    if (ImGui::Button(state.playing ? "Pause" : "Play", ImVec2(60, 0))) state.playing = !state.playing;
    ImGui::SameLine();
    ImGui::PushItemWidth(-1);
    ImGui::SliderFloat("##speed", &state.hours_per_second, 1.0f / 60, 6.0f, "%.2f hours a second",
                       ImGuiSliderFlags_Logarithmic);
    ImGui::PopItemWidth();
    const SunTimes times = sun_times(state.light.day);
    if (times.kind == DayKind::PolarDay) ImGui::TextUnformatted("the sun does not set");
    if (times.kind == DayKind::PolarNight) ImGui::TextUnformatted("the sun does not rise");
    if (times.sunrise && times.sunset) {
        ImGui::Text("sunrise %s, sunset %s", clock_text(*times.sunrise).c_str(), clock_text(*times.sunset).c_str());
    }
}

int days_of(int year, int month) {
    const bool leap = (year % 4 == 0 && year % 100 != 0) || year % 400 == 0;
    constexpr int kDays[] = {31, 28, 31, 30, 31, 30, 31, 31, 30, 31, 30, 31};
    return month == 2 && leap ? 29 : kDays[month - 1];
}

void draw_place(Day& day) {
    slider("latitude", day.latitude, -90, 90, "%.2f N");
    slider("longitude", day.longitude, -180, 180, "%.2f E");
    slider("clock - UTC", day.utc_offset, -12, 14, "%.1f h");
    slider("north", day.north, -180, 180, "%.0f deg");
    ImGui::SliderInt("month", &day.date.month, 1, 12, "%d", ImGuiSliderFlags_AlwaysClamp);
    const int days = days_of(day.date.year, day.date.month);
    ImGui::SliderInt("day", &day.date.day, 1, days, "%d", ImGuiSliderFlags_AlwaysClamp);
    ImGui::InputInt("year", &day.date.year);
    day.date.year = std::clamp(day.date.year, 1900, 2100);
    day.date.day = std::clamp(day.date.day, 1, days_of(day.date.year, day.date.month));
}

void draw_weather(LightSettings& light) {
    slider("clouds", light.clouds, 0, 1, "%.2f");
    slider("turbidity", light.turbidity, 1, 10, "%.1f");
}

void draw_layers(WalkState& state, const Baked* baked) {
    if (!ImGui::BeginCombo("layer", name(state.show))) return;
    for (const Layer layer : {Layer::Final, Layer::Direct, Layer::Indirect, Layer::Irradiance, Layer::Albedo,
                              Layer::Normal, Layer::Depth, Layer::Lightmap, Layer::Volume}) {
        if (layer == Layer::Lightmap && !(baked && baked->lightmap)) continue;
        if (layer == Layer::Volume && !(baked && baked->volume)) continue;
        if (ImGui::Selectable(name(layer), layer == state.show)) state.show = layer;
    }
    ImGui::EndCombo();
}

void draw_volume(WalkState& state) {
    ImGui::Checkbox("volume's samples and cells", &state.volume_view);
    if (!ImGui::BeginCombo("what moves", name(state.volume_mode))) return;
    for (const VolumeMode mode : {VolumeMode::Auto, VolumeMode::Object, VolumeMode::Vertex, VolumeMode::Pixel})
        if (ImGui::Selectable(name(mode), mode == state.volume_mode)) state.volume_mode = mode;
    if (ImGui::IsItemHovered()) ImGui::SetTooltip("where the volume's light is looked up");
    ImGui::EndCombo();
}

void draw_exposure(WalkState& state) {
    ImGui::Checkbox("auto", &state.auto_exposure);
    ImGui::SameLine();
    ImGui::PushItemWidth(150);
    if (state.auto_exposure) {
        ImGui::SliderFloat("exposure", &state.compensation, -4, 4, "%+.1f stops");
    } else {
        ImGui::SliderFloat("exposure", &state.ev, -6, 18, "EV %.1f");
    }
    ImGui::PopItemWidth();
}

void draw_camera(WalkState& state) {
    float fov = state.gaze.vertical_fov / float(kDegree);
    if (ImGui::SliderFloat("view", &fov, 15, 110, "%.0f deg")) state.gaze.vertical_fov = fov * float(kDegree);
    for (std::size_t i = 0; i < state.bookmarks.size(); ++i) {
        const std::string key = i < 9 ? std::to_string(i + 1) + "  " : "    ";
        const std::string label = key + state.bookmarks[i].name + "##bookmark" + std::to_string(i);
        if (ImGui::Selectable(label.c_str())) state.go_to = i;
    }
    if (ImGui::Button("Keep this place (B)")) state.add_bookmark = true;
}

void draw_passes(const FrameReport& frame) {
    constexpr ImGuiTableFlags kLook = ImGuiTableFlags_RowBg | ImGuiTableFlags_BordersInnerV;
    if (!ImGui::BeginTable("passes", 4, kLook)) return;
    ImGui::TableSetupColumn("pass", ImGuiTableColumnFlags_WidthStretch);
    for (const char* heading : {"ms", "draws", "tris"})
        ImGui::TableSetupColumn(heading, ImGuiTableColumnFlags_WidthFixed);
    ImGui::TableHeadersRow();
    for (const PassReport& pass : frame.passes) {
        ImGui::TableNextRow();
        ImGui::TableNextColumn();
        pass.ran ? ImGui::TextUnformatted(pass.name.c_str()) : ImGui::TextDisabled("%s", pass.name.c_str());
        if (ImGui::IsItemHovered() && !pass.why.empty()) ImGui::SetTooltip("%s", pass.why.c_str());
        ImGui::TableNextColumn();
        pass.ran ? ImGui::Text("%.1f", pass.milliseconds) : ImGui::TextDisabled("-");
        ImGui::TableNextColumn();
        if (pass.ran) ImGui::Text("%d", pass.draws);
        ImGui::TableNextColumn();
        if (pass.ran) ImGui::Text("%ld", pass.triangles);
    }
    ImGui::EndTable();
    // The frame plan in words: why each pass ran or did not.
    for (const PassReport& pass : frame.passes) {
        if (!pass.why.empty()) ImGui::TextWrapped("%s: %s", pass.name.c_str(), pass.why.c_str());
    }
}

void draw_light_notes(const WalkState& state, const PanelFacts& facts) {
    if (!facts.baked) {
        ImGui::TextWrapped("no baked light: indirect light is zero");
    } else if (!(facts.baked->light == state.light)) {
        ImGui::TextWrapped("baked for another place, day or weather: indirect light is that one's");
    }
}

void draw_status(const WalkState& state, const PanelFacts& facts) {
    const Vec3& eye = state.gaze.eye;
    ImGui::Text("%.1f ms a frame, %s", facts.frame_milliseconds, state.flying ? "flying" : "on foot");
    ImGui::Text("eye %.1f, %.1f, %.1f   EV %.1f", double(eye.x), double(eye.y), double(eye.z), facts.frame->ev);
    ImGui::Text("%d objects drawn, %d out of sight", facts.frame->objects_drawn, facts.frame->objects_culled);
    ImGui::TextDisabled(facts.mouse_captured ? "Esc frees the mouse" : "click the view to look about; F1 help");
}

}  // namespace

void draw_panel(WalkState& state, const PanelFacts& facts) {
    const ImVec2 window = ImGui::GetIO().DisplaySize;
    ImGui::SetNextWindowPos(ImVec2(0, 0));
    ImGui::SetNextWindowSizeConstraints(ImVec2(kPanelWidth, 0), ImVec2(kPanelWidth, window.y));
    constexpr ImGuiWindowFlags kFixed = ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoMove |
                                        ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_AlwaysAutoResize;
    ImGui::SetNextWindowBgAlpha(0.8f);
    if (ImGui::Begin("daylit", nullptr, kFixed)) {
        ImGui::PushItemWidth(190);
        draw_time(state);
        ImGui::Separator();
        draw_layers(state, facts.baked);
        if (facts.baked && facts.baked->volume) draw_volume(state);
        draw_exposure(state);
        draw_weather(state.light);
        if (!facts.scene->animations.empty()) ImGui::Checkbox("animations", &state.animate);
        if (ImGui::CollapsingHeader("Place and date")) draw_place(state.light.day);
        if (ImGui::CollapsingHeader("Cameras")) draw_camera(state);
        state.pass_times = ImGui::CollapsingHeader("Passes");
        if (state.pass_times) draw_passes(*facts.frame);
        ImGui::Separator();
        draw_light_notes(state, facts);
        draw_status(state, facts);
        if (!state.message.empty()) ImGui::TextWrapped("%s", state.message.c_str());
        ImGui::PopItemWidth();
    }
    state.panel_size = Vec2(ImGui::GetWindowSize().x, ImGui::GetWindowSize().y);
    ImGui::End();
}

void draw_help(WalkState& state) {
    constexpr const char* kLines[][2] = {{"W A S D", "walk"},
                                         {"Shift", "run, or fly fast"},
                                         {"Space", "jump; upwards when flying"},
                                         {"C", "downwards when flying"},
                                         {"F", "fly through walls, or stand again"},
                                         {"mouse, arrows", "look; click the view to capture the mouse"},
                                         {"[  ]", "ten minutes back and on; with Shift an hour"},
                                         {"P", "let the day go by"},
                                         {"1 - 9", "cameras and kept places"},
                                         {"B", "keep this place; prints the options for shot"},
                                         {"R", "reload the shaders that changed"},
                                         {"F12", "save a picture in the working folder"},
                                         {"Tab", "hide or show the panel"},
                                         {"F1", "this page"},
                                         {"Esc", "free the mouse; once more to leave"}};
    const ImVec2 window = ImGui::GetIO().DisplaySize;
    ImGui::SetNextWindowPos(ImVec2(window.x / 2, window.y / 2), ImGuiCond_Always, ImVec2(0.5f, 0.5f));
    constexpr ImGuiWindowFlags kPage = ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove |
                                       ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoSavedSettings |
                                       ImGuiWindowFlags_AlwaysAutoResize;
    if (ImGui::Begin("Keys", &state.help, kPage) && ImGui::BeginTable("keys", 2)) {
        for (const auto& [keys, meaning] : kLines) {
            ImGui::TableNextRow();
            ImGui::TableNextColumn();
            ImGui::TextUnformatted(keys);
            ImGui::TableNextColumn();
            ImGui::TextUnformatted(meaning);
        }
        ImGui::EndTable();
    }
    ImGui::End();
}

}  // namespace daylit

// Links daylit from its installed package: asks for the sun, makes a context, draws a frame of an empty scene.
#include <cstdio>

#include "engine/gl/context.h"
#include "engine/render/renderer.h"
#include "engine/scene/sky.h"

int main() {
    const daylit::LightModel light({}, {});
    const daylit::Lighting noon = light.at(13.4);
    const auto context = daylit::make_any_context();
    daylit::Scene scene;
    scene.materials.emplace_back();
    daylit::Renderer renderer(scene, nullptr);
    renderer.set_lighting(noon);
    renderer.set_pose(daylit::pose_scene(scene));
    daylit::FrameSettings frame;
    frame.view = daylit::look_at({0, 1, 0}, {0, 2, -1}, 1.0f);
    frame.width = frame.height = 16;
    renderer.draw(frame);
    const float sky = daylit::luminance(renderer.read_radiance().at(8, 8));
    std::printf("sun %.0f lx, sky %.0f cd/m^2, %s\n", double(daylit::luminance(noon.suns.at(0).irradiance)), double(sky),
                context->description().c_str());
    return sky > 100.0f && sky < 100000.0f ? 0 : 1;
}

// What a report varies: each point of a sweep differs from the base in its own axis, and the plan follows it.
#include <gtest/gtest.h>

#include <set>

#include "gi/bake_plan.h"
#include "gi/transport/day_gather/sweep.h"

namespace daylit {
namespace {

BakePlan plan_of(const BakeSettings& settings) {
    SceneFacts facts;
    facts.static_triangles = 5000;
    facts.static_nodes_with_mesh = 1;
    LightSettings light;
    light.sun = SunSource::None, light.sky = SkySource::Constant, light.sky_radiance = Rgb(1.0f);
    return plan_bake(facts, LightModel(light, {}), settings);
}

TEST(Sweep, PointsOfTheGatherVaryWhatTheyName) {
    BakeSettings base;
    const BakePlan plan = plan_of(base);
    std::set<std::string> names, axes;
    for (const SweepPoint& point : day_gather_sweep(base)) {
        EXPECT_TRUE(names.insert(point.name).second) << point.name;
        axes.insert(point.axis);
        const BakePlan swept = plan_of(point.settings);
        EXPECT_EQ(swept.rays != plan.rays, point.axis == "rays" || point.axis == "error") << point.name;
        EXPECT_EQ(swept.texel_budget != plan.texel_budget, point.axis == "texels" || point.axis == "error")
            << point.name;
        if (point.name == "rays x 2") {
            EXPECT_EQ(swept.rays, 2 * plan.rays);
        }
        if (point.name == "texels x 0.5") {
            EXPECT_EQ(swept.texel_budget, plan.texel_budget / 2);
        }
    }
    EXPECT_EQ(axes, (std::set<std::string>{"rays", "texels", "error"}));
}

}  // namespace
}  // namespace daylit

// What a report varies: each point of a sweep differs from the base in its own axis, and the plan follows it.
#include <gtest/gtest.h>

#include <set>

#include "gi/bake_plan.h"
#include "gi/encode/sweep.h"
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

TEST(Sweep, PointsOfTheVolumeVaryWhatTheyName) {
    BakeSettings base;
    const VolumeSettings plan = plan_of(base).volume_settings;
    ASSERT_GT(plan.most_cells, 0u);
    std::set<std::string> axes;
    for (const SweepPoint& point : volume_sweep(base)) {
        axes.insert(point.axis);
        const VolumeSettings swept = plan_of(point.settings).volume_settings;
        EXPECT_NE(swept.most_cells, plan.most_cells) << point.name;
        EXPECT_EQ(swept.rays != plan.rays, point.axis == "error") << point.name;
        if (point.name == "cells x 0.25") {
            EXPECT_EQ(swept.most_cells, plan.most_cells / 4);
        }
    }
    EXPECT_EQ(axes, (std::set<std::string>{"cells", "error"}));
}

}  // namespace
}  // namespace daylit

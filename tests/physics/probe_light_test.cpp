// Light and its change at places in free space, against closed forms and against differences.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "gi/transport/day_gather/probe_light.h"
#include "scenes.h"

namespace daylit {
namespace {

/// A room of 4 m whose surfaces shine as a smooth function of the place, in two components.
class Room {
  public:
    explicit Room(const std::function<Rgb(const Vec3&)>& radiance) {
        const std::uint32_t wall = made_.add(lambert(Rgb(0.5f)));
        const Vec3 x(4, 0, 0), y(0, 4, 0), z(0, 0, 4), o(0.0f);
        made_.quad(wall, o, z, x), made_.quad(wall, o + y, x, z), made_.quad(wall, o, y, z);
        made_.quad(wall, o + x, z, y), made_.quad(wall, o, x, y), made_.quad(wall, o + z, y, x);
        rays_.emplace(made_.scene, made_.mesh);
        atlas_ = make_atlas(made_.mesh, 40000);
        texels_ = make_texels(made_.mesh, atlas_);
        scene_.emplace(gather_scene(*rays_, atlas_, texels_, {}));
        Checkpoint nowhere;
        hits_ = trace_hits(*scene_, {.rays = 16}, nowhere, StageProgress{Progress{}});
        for (std::size_t r = 0; r < hits_.receivers.size(); ++r) {
            const TexelPoint p = texels_.points_of(hits_.receivers[r].texel)[0];
            const Rgb value = float(kPi) * radiance(position(made_.mesh, p));
            rows_.push_back(value), rows_.push_back(2.0f * value);
        }
        rows_.resize(rows_.size() + 2 * sky_bins(Environment{}).size(), Rgb(0.0f));
        light_ = {2, rows_, 1, 1};
        gather_.emplace(*scene_, hits_, light_);
    }

    const ProbeGather& gather() const { return *gather_; }

  private:
    TestScene made_;
    std::optional<RayScene> rays_;
    Atlas atlas_;
    Texels texels_;
    std::optional<GatherScene> scene_;
    GatherHits hits_;
    std::vector<Rgb> rows_;
    LeavingLight light_;
    std::optional<ProbeGather> gather_;
};

/// Mean of the two halves of one number.
float number(const ProbeLight& light, std::size_t part, std::size_t i, std::size_t component = 0) {
    const std::size_t at = (part * glsl::kVolumeNumbers + i) * 2 + component;
    return 0.5f * (light.half[0][at] + light.half[1][at]);
}

Rgb smooth(const Vec3& p) {
    return Rgb(2.0f + std::sin(1.3f * p.x + 0.7f * p.z), 2.0f + std::cos(0.9f * p.y - 0.4f * p.x), 1.0f + 0.2f * p.z);
}

TEST(ProbeLight, AnEvenRoomIsEvenAndDoesNotChange) {
    const Room room([](const Vec3&) { return Rgb(3.0f); });
    const ProbeLight light = room.gather().at(Vec3(1.4f, 2.1f, 2.3f), 1, {.rays = 4096});
    EXPECT_NEAR(number(light, 0, 1), 3.0 * std::sqrt(4.0 * kPi), 1e-3);
    EXPECT_NEAR(number(light, 0, 1, 1), 6.0 * std::sqrt(4.0 * kPi), 2e-3);
    EXPECT_EQ(light.backs, 0.0f);
    EXPECT_NEAR(light.nearest, 1.4f, 0.05f);
    for (std::size_t i = 3; i < 27; ++i) EXPECT_NEAR(number(light, 0, i), 0.0, 0.05) << i;
    for (std::size_t part = 1; part < 4; ++part)
        for (std::size_t i = 0; i < 27; ++i) EXPECT_NEAR(number(light, part, i), 0.0, 0.12) << part << " " << i;
}

// Nothing occludes: what a probe's own rays tell of the change is what six probes around tell.
TEST(ProbeLight, ChangeFromOwnRaysIsThatOfDifferences) {
    const Room room(smooth);
    std::vector<double> differences;
    for (std::uint64_t i = 0; i < 12; ++i) {
        Random random(9, i, 0);
        const Vec3 place = Vec3(0.8f) + 2.4f * Vec3(random.next(), random.next(), random.next());
        const ProbeLight own = room.gather().at(place, i, {.rays = 8192});
        const ProbeLight other =
            room.gather().at(place, i, {.rays = 8192, .change = ProbeChange::Differences, .step = 0.1f});
        double apart = 0.0, all = 0.0;
        for (std::size_t part = 1; part < 4; ++part)
            for (std::size_t n = 0; n < 27; ++n) {
                apart += std::pow(double(number(own, part, n)) - double(number(other, part, n)), 2.0);
                all += std::pow(double(number(other, part, n)), 2.0);
            }
        differences.push_back(std::sqrt(apart / all));
        for (std::size_t n = 0; n < 27; ++n) EXPECT_NEAR(number(own, 0, n), number(other, 0, n), 1e-5);
    }
    std::sort(differences.begin(), differences.end());
    std::printf("median relative difference %.3f, worst of %zu %.3f\n", differences[6], differences.size(),
                differences.back());
    EXPECT_LE(differences[6], 0.05);
}

// The weights' change is their derivative: a small surface element seen from places around.
TEST(ProbeLight, TheWeightsOfASurfaceElementChangeAsItsSolidAngleDoes) {
    const Vec3 element(1.0f, 2.0f, -0.5f), normal = glm::normalize(Vec3(-0.3f, -1.0f, 0.2f));
    constexpr double kArea = 1e-3, kStep = 1e-3;
    const auto weights = [&](const Vec3& from) {
        const Vec3 to = element - from;
        const float r = glm::length(to);
        const Vec3 d = to / r;
        return sh_weights(d, float(kArea) * std::abs(glm::dot(d, normal)) / (r * r), r, normal);
    };
    const Vec3 place(0.2f, 0.1f, 0.3f);
    const auto here = weights(place);
    for (std::size_t a = 0; a < 3; ++a) {
        Vec3 step(0.0f);
        step[glm::length_t(a)] = float(kStep);
        const auto up = weights(place + step), down = weights(place - step);
        for (std::size_t i = 0; i < 9; ++i)
            EXPECT_NEAR(here[1 + a][i], (up[0][i] - down[0][i]) / (2 * kStep), 2e-3 * kArea) << a << " " << i;
    }
}

}  // namespace
}  // namespace daylit

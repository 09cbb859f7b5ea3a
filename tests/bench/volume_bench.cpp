// What a look-up in an irradiance volume costs, one place at a time and many at once, beside one in a uniform grid of
// as many bytes, blended trilinearly.
//   daylit_bench --benchmark_filter=volume_lookup
// Hot: the vertices of a thing of half a metre, over and over. Cold: anywhere in a volume larger than the caches.
// Every way is checked against the field that the volume was filled with before it is timed.
#include <benchmark/benchmark.h>

#include <cmath>
#include <string>

#include "engine/baked/volume_batch.h"
#include "engine/base/random.h"
#include "gi/encode/volume_octree.h"
#include "gi/encode/volume_records.h"

namespace daylit {
namespace {

constexpr float kSide = 16.0f;                      // of the volume, metres
constexpr std::size_t kHot = 512, kCold = 1 << 18;  // places
constexpr float kWrong = 0.01f;                     // relative: what halves and bytes lose

/// Radiance SH that changes evenly from place to place, so that any blend is exact.
float field(std::size_t number, const Vec3& place) {
    return (number < 3 ? 100.0f : 0.0f) + (0.2f * float(number % 5) - 0.3f) * glm::dot(place, Vec3(1.0f, 2.0f, -0.5f));
}
Vec3 field_change(std::size_t number) {
    return (0.2f * float(number % 5) - 0.3f) * Vec3(1.0f, 2.0f, -0.5f);
}

IrradianceVolume make_volume() {
    Octree octree(Vec3(0.0f), kSide / 4.0f, {4, 4, 4});
    Random random(1, 0, 0);
    for (std::uint32_t n = 0; n < octree.nodes.size(); ++n)
        if (octree.nodes[n].level < 3 || (octree.nodes[n].level < 4 && random.next() < 0.2f)) octree.split(n);
    const OctreeCells made = make_cells(octree, [](const Lattice&, const LeafSide&, const LeafSide&) { return true; });
    IrradianceVolume volume;
    volume.tree = made.tree;
    volume.basis.hours = {12.0}, volume.basis.components = 1, volume.basis.curves = {0, 0, 0, 0, 1};
    std::vector<float> records;
    for (const auto& sample : made.samples) {
        for (std::size_t i = 0; i < kRecordNumbers; ++i) records.push_back(field(i, octree.place(sample.at)));
        for (glm::length_t axis = 0; axis < 3; ++axis)
            for (std::size_t i = 0; i < kRecordNumbers; ++i) records.push_back(field_change(i)[axis]);
    }
    store_records(records, 0.0f, volume);
    return volume;
}

/// Values at the corners of equal cells.
class UniformGrid {
  public:
    explicit UniformGrid(std::size_t bytes)
        : count_(std::size_t(std::cbrt(double(bytes) / double(kRow * sizeof(float))))),
          rows_(kRow * count_ * count_ * count_) {
        for (std::size_t at = 0; at < rows_.size() / kRow; ++at)
            for (std::size_t i = 0; i < kRecordNumbers; ++i)
                rows_[at * kRow + i] =
                    field(i, kSide / float(count_ - 1) * Vec3(at % count_, at / count_ % count_, at / count_ / count_));
    }

    Rgb irradiance(const Vec3& place, const Vec3& normal) const {
        const Vec3 in = glm::clamp(place / kSide, Vec3(0.0f), Vec3(1.0f)) * float(count_ - 1);
        const Vec3 low = glm::min(glm::floor(in), Vec3(float(count_ - 2)));
        const Vec3 t = in - low;
        const std::size_t first = (std::size_t(low.z) * count_ + std::size_t(low.y)) * count_ + std::size_t(low.x);
        float sum[kRow] = {};
        for (std::size_t corner = 0; corner < 8; ++corner) {
            const Vec3 at(corner & 1, corner >> 1 & 1, corner >> 2), share = glm::mix(Vec3(1.0f) - t, t, at);
            const float weight = share.x * share.y * share.z;
            const float* row = rows_.data() + kRow * (first + (corner & 1) + (corner >> 1 & 1) * count_ +
                                                      (corner >> 2) * count_ * count_);
            for (std::size_t i = 0; i < kRow; ++i) sum[i] += weight * row[i];
        }
        glsl::VolumeSh sh;
        for (std::size_t i = 0; i < 9; ++i) sh.c[i] = Vec3(sum[3 * i], sum[3 * i + 1], sum[3 * i + 2]);
        return glsl::volume_irradiance(sh, normal, 1.0f);
    }

  private:
    static constexpr std::size_t kRow = 32;
    std::size_t count_;
    std::vector<float> rows_;
};

struct Asked {
    std::vector<Vec3> places, normals;
};

Asked ask(bool hot) {
    Asked asked;
    Random random(2, 0, 0);
    for (std::size_t i = 0; i < (hot ? kHot : kCold); ++i) {
        const Vec3 share(random.next(), random.next(), random.next());
        asked.places.push_back(hot ? Vec3(7.0f, 6.0f, 5.0f) + 0.5f * share : kSide * share);
        asked.normals.push_back(glm::normalize(Vec3(random.next(), random.next(), random.next()) - 0.5f));
    }
    return asked;
}

bool right(const Asked& asked, const std::vector<Rgb>& found) {
    for (std::size_t i = 0; i < found.size(); ++i) {
        glsl::VolumeSh sh;
        for (std::size_t k = 0; k < kRecordNumbers; ++k) sh.c[k / 3][glm::length_t(k % 3)] = field(k, asked.places[i]);
        const Rgb expected = glsl::volume_irradiance(sh, asked.normals[i], 1.0f);
        if (!(glm::length(found[i] - expected) <= kWrong * glm::length(expected))) return false;
    }
    return true;
}

/// look_up   (asked, out): fills out
template <class LookUp>
void time_look_ups(benchmark::State& state, const LookUp& look_up) {
    const Asked asked = ask(state.range(0) != 0);
    std::vector<Rgb> found(asked.places.size());
    look_up(asked, found);
    if (!right(asked, found)) {
        state.SkipWithError("wrong light");
        return;
    }
    for (auto _ : state) {
        look_up(asked, found);
        benchmark::DoNotOptimize(found.data());
    }
    state.counters["s/sample"] = benchmark::Counter(
        double(found.size()), benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

/// The volume, made once.
struct Made {
    IrradianceVolume volume = make_volume();
    VolumeLight light{volume, volume.basis.weights({}, 12.0)};
};
const Made& made() {
    static const Made once;
    return once;
}

void volume_lookup_single(benchmark::State& state) {
    const VolumeLight& light = made().light;
    time_look_ups(state, [&](const Asked& asked, std::vector<Rgb>& out) {
        for (std::size_t i = 0; i < out.size(); ++i) out[i] = light.irradiance(asked.places[i], asked.normals[i]);
    });
    state.counters["cells"] = double(made().volume.tree.cells.size());
}

void volume_lookup_batch(benchmark::State& state) {
    const VolumeBatch batch(made().light);
    time_look_ups(
        state, [&](const Asked& asked, std::vector<Rgb>& out) { batch.irradiance(asked.places, asked.normals, out); });
}

void volume_lookup_uniform_grid(benchmark::State& state) {
    const UniformGrid grid(made().light.records().size_bytes());
    time_look_ups(state, [&](const Asked& asked, std::vector<Rgb>& out) {
        for (std::size_t i = 0; i < out.size(); ++i) out[i] = grid.irradiance(asked.places[i], asked.normals[i]);
    });
}

BENCHMARK(volume_lookup_single)->ArgName("hot")->Arg(1)->Arg(0)->Unit(benchmark::kMicrosecond);
BENCHMARK(volume_lookup_batch)->ArgName("hot")->Arg(1)->Arg(0)->Unit(benchmark::kMicrosecond);
BENCHMARK(volume_lookup_uniform_grid)->ArgName("hot")->Arg(1)->Arg(0)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace daylit

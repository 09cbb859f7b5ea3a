#include "gi/encode/encode_volume.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <mutex>
#include <tuple>

#include "gi/encode/judged_basis.h"
#include "gi/encode/volume_budget.h"
#include "gi/encode/volume_fit.h"
#include "gi/encode/volume_records.h"
#include "shaders/shared/sh.h"

namespace daylit {
namespace {

constexpr int kPilots = 400;  // samples that the basis is chosen by,
// with at least so many rays: what noise adds to their light would ask for components, in place of light that is there.
constexpr int kPilotRays = 1024;
constexpr std::size_t kJudgedMoments = 6;
// Three bands of a single far light ring by 4 to 6 % of its brightness: less than a window would dim its bright side
// by.
constexpr float kCutShare = 0.05f;
constexpr float kMostWindow = 4.0f;  // the largest lambda that is tried

const std::array<Vec3, kJudgedSides> kSides = {Vec3(1, 0, 0),  Vec3(-1, 0, 0), Vec3(0, 1, 0),
                                               Vec3(0, -1, 0), Vec3(0, 0, 1),  Vec3(0, 0, -1)};

/// Dynamic nodes that rest inside of something solid.
std::vector<std::string> buried_nodes(const Scene& scene, const FreeSpace& space) {
    const WorldMesh mesh = world_mesh(scene, pose_scene(scene), Part::Dynamic);
    std::map<std::uint32_t, Bounds> box;
    for (std::size_t t = 0; t < mesh.triangle_count(); ++t)
        for (std::size_t k = 0; k < 3; ++k) box[mesh.nodes[t]].add(mesh.positions[mesh.indices[3 * t + k]]);
    std::vector<std::string> names;
    for (const auto& [node, bounds] : box)
        if (space.buried(0.5f * (bounds.min + bounds.max)))
            names.push_back(scene.nodes[node].name.empty() ? "node " + std::to_string(node) : scene.nodes[node].name);
    return names;
}

/// From the gather's components to the file's: [part][number][component] both.
class Turn {
  public:
    explicit Turn(const Eigen::MatrixXf& matrix) : matrix_(matrix) {}

    std::vector<float> operator()(const std::vector<float>& light) const {
        using Matrix = Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
        const Eigen::Index rows = Eigen::Index(light.size()) / matrix_.rows();
        std::vector<float> result(std::size_t(rows * matrix_.cols()));
        Eigen::Map<Matrix>(result.data(), rows, matrix_.cols()).noalias() =
            Eigen::Map<const Matrix>(light.data(), rows, matrix_.rows()) * matrix_;
        return result;
    }

  private:
    const Eigen::MatrixXf& matrix_;
};

std::vector<float> mean_of_halves(const ProbeLight& light) {
    std::vector<float> mean(light.half[0].size());
    for (std::size_t i = 0; i < mean.size(); ++i) mean[i] = 0.5f * (light.half[0][i] + light.half[1][i]);
    return mean;
}

/// Rows of irradiance on six sides of places here and there in free space, in the gather's components.
std::vector<Rgb> pilot_rows(const ProbeGather& gather, const FreeSpace& space, const std::vector<Bounds>& regions,
                            std::size_t components, const VolumeSettings& settings) {
    Bounds all = space.box();
    for (const Bounds& b : regions)
        if (!b.empty()) all.add(b.min), all.add(b.max);
    std::vector<Vec3> places;
    Random random(settings.seed, 0, 11);
    for (int tries = 0; tries < 100 * kPilots && int(places.size()) < kPilots && !all.empty(); ++tries) {
        const Vec3 place = all.min + Vec3(random.next(), random.next(), random.next()) * (all.max - all.min);
        const bool outside = space.box().empty() || glm::any(glm::lessThan(place, space.box().min)) ||
                             glm::any(glm::greaterThan(place, space.box().max));
        if (outside || space.reachable(place)) places.push_back(place);
    }
    std::vector<Rgb> rows(places.size() * kSides.size() * components, Rgb(0.0f));
    tbb::parallel_for(std::size_t(0), places.size(), [&](std::size_t p) {
        const ProbeLight light = gather.at(
            places[p], p,
            {.rays = std::max(settings.rays, kPilotRays), .change = ProbeChange::None, .seed = settings.seed + 1});
        const std::vector<float> mean = mean_of_halves(light);
        for (std::size_t side = 0; side < kSides.size(); ++side) {
            const glsl::Sh9 lobe = glsl::sh_irradiance_weights(kSides[side]);
            for (std::size_t i = 0; i < kRecordNumbers; ++i)
                for (std::size_t r = 0; r < components; ++r)
                    rows[(p * kSides.size() + side) * components + r][glm::length_t(i % 3)] +=
                        lobe.c[i / 3] * mean[i * components + r];
        }
    });
    return rows;
}

/// Moments spread over those that there are.
std::vector<Moment> judged_moments(std::span<const Moment> moments) {
    const std::size_t count = std::min(moments.size(), kJudgedMoments);
    std::vector<Moment> result;
    for (std::size_t i = 0; i < count; ++i) result.push_back(moments[(2 * i + 1) * moments.size() / (2 * count)]);
    return result;
}

/// Luminance of irradiance on six sides at several moments, over exposure: [side][moment], as sums over light's
/// numbers.
class VolumeJudge {
  public:
    VolumeJudge(const LightBasis& basis, std::span<const Moment> moments) : components_(std::size_t(basis.components)) {
        for (const Moment& m : moments) {
            weights_.push_back(basis.weights(m.scales, m.hour));
            for (Rgb& w : weights_.back()) w *= Vec3(0.2126f, 0.7152f, 0.0722f) / float(m.exposure);
        }
    }
    std::size_t functionals() const { return kSides.size() * weights_.size(); }

    /// Of `parts` parts: [part][functional].
    std::vector<float> operator()(const float* light, std::size_t parts) const {
        std::vector<float> result(parts * functionals(), 0.0f);
        for (std::size_t part = 0; part < parts; ++part)
            for (std::size_t m = 0; m < weights_.size(); ++m) {
                std::array<float, 9> sh{};
                for (std::size_t i = 0; i < kRecordNumbers; ++i) {
                    const float* row = light + (part * kRecordNumbers + i) * components_;
                    for (std::size_t r = 0; r < components_; ++r)
                        sh[i / 3] += weights_[m][r][glm::length_t(i % 3)] * row[r];
                }
                for (std::size_t side = 0; side < kSides.size(); ++side) {
                    const glsl::Sh9 lobe = glsl::sh_irradiance_weights(kSides[side]);
                    for (std::size_t i = 0; i < 9; ++i)
                        result[part * functionals() + side * weights_.size() + m] += lobe.c[i] * sh[i];
                }
            }
        return result;
    }

  private:
    std::size_t components_;
    std::vector<std::vector<Rgb>> weights_;
};

VolumeSample sample(const ProbeGather& gather, const Turn& turn, const VolumeJudge& judge, const Vec3& place,
                    std::uint64_t key, const VolumeSettings& settings) {
    const ProbeLight light = gather.at(place, key, {.rays = settings.rays, .seed = settings.seed});
    VolumeSample result;
    const std::array<std::vector<float>, 2> half = {turn(light.half[0]), turn(light.half[1])};
    std::vector<float> mean(half[0].size()), apart(half[0].size());
    for (std::size_t i = 0; i < apart.size(); ++i) {
        mean[i] = 0.5f * (half[0][i] + half[1][i]);
        apart[i] = 0.5f * (half[0][i] - half[1][i]);
    }
    result.light = SampleLight(mean, 4);
    result.judged = judge(mean.data(), 4);
    const std::vector<float> noise = judge(apart.data(), 4);
    const std::size_t functionals = judge.functionals();
    // One difference tells little about one functional; all together tell how noisy this place is.
    double of_value = 0.0, of_change = 0.0, bright = 0.0;
    for (std::size_t f = 0; f < functionals; ++f) {
        of_value += double(noise[f]) * double(noise[f]);
        bright += double(result.judged[f]) * double(result.judged[f]);
        for (std::size_t a = 1; a < 4; ++a)
            of_change += double(noise[a * functionals + f]) * double(noise[a * functionals + f]) / 3.0;
    }
    const double relative = bright > 0.0 ? std::sqrt(of_value / bright) : 0.0;
    result.noise.resize(functionals);
    for (std::size_t f = 0; f < functionals; ++f) result.noise[f] = float(relative) * std::abs(result.judged[f]);
    result.change_noise = of_value > 0.0 ? float(std::sqrt(of_change / of_value)) : 0.0f;
    result.nearness = light.nearness;
    return result;
}

/// Takes away ringing (Sloan 2008): coefficients of band l over 1 + lambda l^2 (l + 1)^2, with the smallest lambda that
/// keeps irradiance on every side at every judged moment from falling below zero by more than a share of the brightest
/// side's: what little is left, look-ups cut at zero, while a wider window would dim the bright side. Returns lambda.
float window(float* record, std::size_t components, const VolumeJudge& judge) {
    const std::size_t numbers = kRecordNumbers * components;
    std::vector<float> tried(record, record + numbers);
    float lambda = 0.0f;
    for (;;) {
        const std::vector<float> judged = judge(tried.data(), 1);
        const auto [least, most] = std::minmax_element(judged.begin(), judged.end());
        if (*least >= -kCutShare * *most || lambda >= kMostWindow) break;
        lambda = lambda == 0.0f ? 0.002f : 1.25f * lambda;
        for (std::size_t i = 0; i < numbers; ++i) {
            const std::size_t coefficient = i / components / 3;
            const float l = coefficient == 0 ? 0.0f : coefficient < 4 ? 1.0f : 2.0f;
            tried[i] = record[i] / (1.0f + lambda * l * l * (l + 1.0f) * (l + 1.0f));
        }
    }
    if (lambda > 0.0f)
        for (std::size_t part = 0; part < 4; ++part)
            for (std::size_t i = 0; i < numbers; ++i) {
                const std::size_t coefficient = i / components / 3;
                const float l = coefficient == 0 ? 0.0f : coefficient < 4 ? 1.0f : 2.0f;
                record[part * numbers + i] /= 1.0f + lambda * l * l * (l + 1.0f) * (l + 1.0f);
            }
    return lambda;
}

/// RMS over mean of irradiance at all places that were measured inside cells.
double measure(const OctreeCells& cells, const RefinedVolume& refined, const IrradianceVolume& volume,
               const LightBasis& dense, std::span<const Moment> moments) {
    const VolumeJudge stated(dense, moments);
    double wrong = 0.0, mean = 0.0;
    std::size_t count = 0;
    for (std::size_t m = 0; m < moments.size(); ++m) {
        const VolumeLight light(volume, volume.basis.weights(moments[m].scales, moments[m].hour));
        const glsl::VolumeArrays arrays = light.arrays();
        for (std::uint32_t c = 0; c < cells.cells.size(); ++c) {
            const RefinedLeaf& leaf = refined.leaves.at(cells.cells[c].leaf);
            for (int p = 0; p < kLeafPlaces; ++p) {
                const int s = refined.places.places[leaf.place[std::size_t(p)]].sample;
                if (leaf.side[std::size_t(p)] != cells.cells[c].side || s < 0 || is_corner(p)) continue;
                const glsl::VolumeSh sh = glsl::volume_sh(arrays, {c, 0.5f * Vec3(p % 3, p / 3 % 3, p / 9)});
                for (std::size_t side = 0; side < kSides.size(); ++side) {
                    const double found =
                        double(luminance(glsl::volume_irradiance(sh, kSides[side], 1.0f))) / moments[m].exposure;
                    const double truth =
                        double(refined.places.samples[std::size_t(s)].judged[side * moments.size() + m]);
                    wrong += (found - truth) * (found - truth), mean += truth, ++count;
                }
            }
        }
    }
    return mean > 0.0 ? std::sqrt(wrong * double(count)) / mean : 0.0;
}

/// Samples that were taken, by place and key.
class KeptSamples {
  public:
    template <class Make>
    VolumeSample get(const Vec3& place, std::uint64_t key, const Make& make) {
        const Where where{place.x, place.y, place.z, key};
        {
            const std::lock_guard lock(mutex_);
            const auto found = samples_.find(where);
            if (found != samples_.end()) return found->second;
        }
        VolumeSample made = make();
        const std::lock_guard lock(mutex_);
        samples_.emplace(where, made);
        return made;
    }

  private:
    using Where = std::tuple<float, float, float, std::uint64_t>;
    std::mutex mutex_;
    std::map<Where, VolumeSample> samples_;
};

}  // namespace

struct VolumeEncoder::State {
    State(const Scene& scene, const Reachable& reachable, const GatherScene& gather, const GatherHits& hits,
          const LightBasis& light, const LeavingLight& leaving_light, std::span<const Moment> moments,
          const VolumeSettings& settings, const BasisSettings& basis_settings)
        : rays(gather.rays),
          sampling(settings),
          leaving(leaving_light),
          regions(reachable.regions),
          space(reachable.space),
          buried(buried_nodes(scene, space)),
          probes(gather, hits, leaving),
          pilots(pilot_rows(probes, space, regions, leaving.components, settings)),
          basis(judge_basis({.light = light, .rows = pilots, .moments = {moments.begin(), moments.end()}},
                            basis_settings)),
          judged(judged_moments(moments)),
          judge(basis.dense, judged),
          turn(basis.turn) {}

    const RayScene& rays;
    VolumeSettings sampling;
    LeavingLight leaving;
    const std::vector<Bounds>& regions;
    const FreeSpace& space;
    std::vector<std::string> buried;
    ProbeGather probes;
    std::vector<Rgb> pilots;
    JudgedBasis basis;
    std::vector<Moment> judged;
    VolumeJudge judge;
    Turn turn;
    std::unique_ptr<KeptSamples> kept;
};

VolumeEncoder::VolumeEncoder(const Scene& scene, const Reachable& reachable, const GatherScene& gather,
                             const GatherHits& hits, const LightBasis& light, const LeavingLight& leaving,
                             std::span<const Moment> moments, const VolumeSettings& settings,
                             const BasisSettings& basis, bool keep_samples)
    : state_(std::make_unique<State>(scene, reachable, gather, hits, light, leaving, moments, settings, basis)) {
    if (keep_samples) state_->kept = std::make_unique<KeptSamples>();
}

VolumeEncoder::~VolumeEncoder() = default;

std::array<int, 3> VolumeEncoder::roots() const {
    return lay_octree(state_->space, state_->regions).size;
}

std::vector<float> VolumeEncoder::gathered(const Vec3& place, std::uint64_t key, int rays) const {
    std::vector<float> mean = mean_of_halves(
        state_->probes.at(place, key, {.rays = rays, .change = ProbeChange::None, .seed = state_->sampling.seed + 2}));
    mean.resize(kRecordNumbers * state_->leaving.components);
    return mean;
}

EncodedVolume VolumeEncoder::encode(const VolumeSettings& settings, const StageProgress& progress) const {
    const State& s = *state_;
    EncodedVolume result;
    result.buried = s.buried;
    const std::size_t components = std::size_t(s.basis.stored.components);
    require_affordable(settings, roots(), bytes_per_volume_cell(components, s.judge.functionals()));
    const auto take = [&](const Vec3& place, std::uint64_t key) {
        const auto trace = [&] { return sample(s.probes, s.turn, s.judge, place, key, s.sampling); };
        return s.kept ? s.kept->get(place, key, trace) : trace();
    };
    const RefinedVolume refined =
        refine_volume(s.rays, s.space, s.regions, take, settings,
                      {progress.report, progress.begin, 0.2 * progress.begin + 0.8 * progress.end});
    const OctreeCells cells = make_cells(refined.octree, same_light_by_rays(refined, s.space));
    VolumeFit fit = fit_volume(cells, refined, kRecordNumbers * components, settings.blend);
    // Records inside of walls stand for what their cells interpolate, not for light that is there.
    for (std::size_t r = 0; r < cells.samples.size(); ++r)
        if (fit.measured[r])
            result.window =
                std::max(result.window,
                         double(window(fit.records.data() + 4 * r * kRecordNumbers * components, components, s.judge)));
    result.volume.tree = cells.tree;
    result.volume.basis = s.basis.stored;
    store_records(fit.records, settings.rounding, result.volume);
    if (settings.blend == VolumeBlend::Adini)
        result.error = measure(cells, refined, result.volume, s.basis.dense, s.judged);
    result.samples = refined.places.samples.size();
    result.unmeasured = std::size_t(std::count(fit.measured.begin(), fit.measured.end(), false));
    result.budget_spent = refined.budget_spent;
    if (s.kept) result.records = std::move(fit.records);
    progress.at(1.0);
    return result;
}

}  // namespace daylit

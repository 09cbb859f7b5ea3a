#include "demo/report/lightmap_encodings.h"

#include <tbb/parallel_for.h>

#include <cmath>
#include <glm/gtc/packing.hpp>

#include "demo/lightmap_points.h"
#include "demo/parse.h"
#include "demo/report/equal_error.h"
#include "engine/baked/bilinear.h"
#include "engine/baked/lightmap_sections.h"
#include "engine/base/error.h"
#include "engine/base/exposure.h"
#include "engine/base/yee.h"
#include "gi/encode/paper_pca.h"
#include "gi/encode/sweep.h"
#include "gi/lightmap_rows.h"
#include "gi/solved_day.h"

namespace daylit {
namespace {

constexpr float kGrey = 0.5f;              // albedo of the surfaces that are displayed
constexpr std::size_t kJudged = 40000;     // pixels, about: tiles spread over the atlas
constexpr int kDayFrames = 288;            // of a whole day, every 5 minutes
constexpr double kPixelsPerDegree = 67.0;  // as elsewhere in the report
constexpr int kNoticeable = 100;           // pixels: PerceptualDiff's own threshold (Yee et al. 2004)

/// The uncompressed day.
struct Uncompressed {
    LightmapRows rows;
    std::vector<std::uint32_t> pixels;  // of the atlas that show something
    std::vector<std::uint32_t> row;     // that each shows
    FilmRows film;                      // of these pixels, at every hour that was solved for
    std::vector<LightScales> scales;    // at these hours
};

void make_film(const LightModel& light, Uncompressed& day) {
    for (std::uint32_t p = 0; p < day.rows.row_of_pixel.size(); ++p)
        if (day.rows.row_of_pixel[p] != ~0u) day.pixels.push_back(p), day.row.push_back(day.rows.row_of_pixel[p]);
    const LightBasis& basis = day.rows.basis;
    day.film.hours = basis.hours, day.film.components = std::size_t(basis.components);
    day.film.rows = day.rows.texels, day.film.at = day.row;
    day.film.weights.resize(3 * day.film.components * basis.hours.size());
    for (std::size_t k = 0; k < basis.hours.size(); ++k) {
        day.scales.push_back(light.scales(basis.hours[k], light.settings().clouds));
        const std::vector<Rgb> weights = basis.weights(day.scales.back(), basis.hours[k]);
        for (std::size_t r = 0; r < weights.size(); ++r)
            for (std::size_t c = 0; c < 3; ++c)
                day.film.weights[(3 * r + c) * basis.hours.size() + k] = double(weights[r][int(c)]);
    }
}

/// Indices of film pixels: those of every so many tiles.
std::vector<std::uint32_t> judged_pixels(const Uncompressed& day) {
    const auto width = std::uint32_t(day.rows.shape.width);
    const std::size_t every = std::max<std::size_t>(1, day.pixels.size() / kJudged);
    std::vector<std::uint32_t> result;
    for (std::uint32_t i = 0; i < day.pixels.size(); ++i) {
        const std::uint32_t x = day.pixels[i] % width, y = day.pixels[i] / width;
        const std::size_t tile = day.rows.shape.tile_at(int(x), int(y));
        if (tile % every == 0) result.push_back(i);
    }
    return result;
}

Image radiance_of(const std::vector<Rgb>& light) {
    Image image(int(light.size()), 1);
    for (std::size_t i = 0; i < light.size(); ++i) image.pixels[i] = kGrey / kPiF * light[i];
    return image;
}

std::vector<Rgb> displayed(const std::vector<Rgb>& light, double ev) {
    Image image = tonemap(radiance_of(light), ev);
    for (Rgb& p : image.pixels) p = Rgb(encode_srgb(p.r), encode_srgb(p.g), encode_srgb(p.b));
    return std::move(image.pixels);
}

/// What is judged, uncompressed: at every hour.
struct DisplayedTruth {
    std::vector<std::uint32_t> pixels;     // of the film
    std::vector<double> ev;                // per frame
    std::vector<std::vector<Rgb>> frames;  // sRGB values
};

DisplayedTruth display_truth(const Uncompressed& day) {
    DisplayedTruth truth;
    truth.pixels = judged_pixels(day);
    std::vector<std::uint32_t> rows;
    for (const std::uint32_t p : truth.pixels) rows.push_back(day.row[p]);
    FilmRows film = day.film;
    film.at = rows;
    for (std::size_t k = 0; k < film.frames(); ++k) {
        const std::vector<Rgb> light = film.frame(k);
        truth.ev.push_back(auto_ev(radiance_of(light)));
        truth.frames.push_back(displayed(light, truth.ev.back()));
    }
    return truth;
}

/// A way to store it.
struct Encoded {
    double bytes = 0.0;
    std::function<std::vector<Rgb>(std::size_t frame)> judged;      // light of the judged pixels, lux
    std::function<std::vector<Rgb>(const Instant& instant)> whole;  // of all the film's, lux
};

Encoded encode(const Uncompressed& day, const DisplayedTruth& truth, const LightmapSettings& settings) {
    const auto map = std::make_shared<DayLightmap>(
        encode_lightmap(day.rows.shape, day.rows.light(), {}, day.rows.row_of_pixel, settings).map);
    Encoded result;
    for (const CodedSection& section : code_lightmap(*map))
        if (std::string_view(section.entry.name.data(), 4) != "LMUV") result.bytes += double(section.stored.size());
    const auto light = [&day, map](const Instant& at, const std::vector<std::uint32_t>& atlas_pixels) {
        const std::vector<Rgb> tiles = map->tile_light(map->basis.weights(at.scales, at.hour));
        std::vector<Rgb> found(atlas_pixels.size());
        tbb::parallel_for(std::size_t(0), found.size(), [&](std::size_t i) {
            const auto width = std::uint32_t(map->width);
            const Vec2 centre = Vec2(atlas_pixels[i] % width, atlas_pixels[i] / width) + 0.5f;
            found[i] = map->irradiance(centre / Vec2(map->width, map->height), tiles);
        });
        return found;
    };
    std::vector<std::uint32_t> judged;
    for (const std::uint32_t p : truth.pixels) judged.push_back(day.pixels[p]);
    result.judged = [&day, light, judged](std::size_t k) { return light({day.film.hours[k], day.scales[k]}, judged); };
    result.whole = [&day, light](const Instant& at) { return light(at, day.pixels); };
    return result;
}

/// What the paper's scheme judges intervals by: the atlas as displayed, by Yee's metric.
FramesDiffer noticeable(const Uncompressed& day, const DisplayedTruth& truth) {
    return [&](std::size_t a, std::size_t b, std::size_t middle) {
        const auto atlas = [&](const std::vector<Rgb>& light) {
            Image image(day.rows.shape.width, day.rows.shape.height);
            const Image shown = tonemap(radiance_of(light), truth.ev[middle]);
            for (std::size_t i = 0; i < light.size(); ++i) image.pixels[day.pixels[i]] = shown.pixels[i];
            return image;
        };
        const std::vector<Rgb> first = day.film.frame(a), last = day.film.frame(b);
        const std::vector<double>& hours = day.film.hours;
        const float share = float((hours[middle] - hours[a]) / (hours[b] - hours[a]));
        std::vector<Rgb> between(first.size());
        for (std::size_t i = 0; i < between.size(); ++i) between[i] = glm::mix(first[i], last[i], share);
        const Image mixed = atlas(between);
        for (const std::vector<Rgb>* end : {&first, &last}) {
            const std::vector<unsigned char> seen = yee_visible(mixed, atlas(*end), kPixelsPerDegree);
            if (std::count(seen.begin(), seen.end(), 1) > kNoticeable) return true;
        }
        return false;
    };
}

/// intervals   which frames the paper's test keeps
Encoded encode(const Uncompressed& day, const DisplayedTruth& truth, const PaperSettings& settings,
               const std::vector<std::size_t>& intervals) {
    const auto film = std::make_shared<FilmRows>(settings.intervals ? day.film.only(intervals) : day.film);
    Encoded result;
    if (settings.vectors == 0) {
        const auto judged_rows = std::make_shared<std::vector<std::uint32_t>>();
        for (const std::uint32_t p : truth.pixels) judged_rows->push_back(day.row[p]);
        const auto judged = std::make_shared<FilmRows>(*film);
        judged->at = *judged_rows;
        result.bytes = film->bytes();
        result.judged = [&day, judged, judged_rows](std::size_t k) { return judged->played(day.film.hours[k]); };
        result.whole = [film](const Instant& at) { return film->played(at.hour); };
        return result;
    }
    const auto pca = std::make_shared<PaperPca>(paper_pca(*film, settings.vectors));
    const auto judged = std::make_shared<PaperPca>(pca->of(truth.pixels));
    result.bytes = double(code_section("PAPR", pca->bytes()).stored.size());
    result.judged = [&day, judged](std::size_t k) { return judged->light(day.film.hours[k]); };
    result.whole = [pca](const Instant& at) { return pca->light(at.hour); };
    return result;
}

/// RMS of what a display shows at the worst of all hours, and at the worst while the sun is up.
void judge_display(const Uncompressed& day, const DisplayedTruth& truth, const Encoded& encoded,
                   const LightSettings& light, RunResult& run) {
    double worst = 0.0, sunlit = 0.0, worst_hour = 0.0, sunlit_hour = 0.0;
    for (std::size_t k = 0; k < truth.frames.size(); ++k) {
        const std::vector<Rgb> shown = displayed(encoded.judged(k), truth.ev[k]);
        double sum = 0.0;
        for (std::size_t i = 0; i < shown.size(); ++i) {
            const glm::dvec3 off = glm::dvec3(shown[i]) - glm::dvec3(truth.frames[k][i]);
            sum += glm::dot(off, off);
        }
        const double error = std::sqrt(sum / (3.0 * double(std::max<std::size_t>(shown.size(), 1))));
        const double hour = day.film.hours[k];
        const bool sun_up = light.sun != SunSource::Day || sun_position(light.day, hour).apparent_elevation > 0.0;
        if (error > worst) worst = error, worst_hour = hour;
        if (sun_up && error > sunlit) sunlit = error, sunlit_hour = hour;
    }
    run.values["displayed_worst"] = worst, run.values["displayed_sunlit"] = sunlit;
    run.note = "worst at " + clock_text(worst_hour) + ", while the sun is up at " + clock_text(sunlit_hour);
}

void judge_points(const Uncompressed& day, const std::vector<Vec2>& uvs, const Judges& judges, const Encoded& encoded,
                  RunResult& run) {
    LightAtPoints found;
    Image atlas(day.rows.shape.width, day.rows.shape.height);
    for (const double hour : judges.surface.hours) {
        const LightModel& model = judges.level.light;
        const std::vector<Rgb> light = encoded.whole({hour, model.scales(hour, model.settings().clouds)});
        for (std::size_t i = 0; i < light.size(); ++i) atlas.pixels[day.pixels[i]] = light[i];
        std::vector<Rgb>& at_points = found.emplace_back();
        for (const Vec2& uv : uvs)
            at_points.push_back(bilinear(atlas.width, atlas.height, uv, [&](int x, int y) { return atlas.at(x, y); }));
    }
    run.values.merge(judge(found, judges.surface));
}

void compare(const std::vector<RunResult>& runs, const char* error, const char* key, const std::string& when,
             std::vector<Finding>& findings) {
    const auto ratio =
        cost_at_equal_error(bytes_and_error(runs, "tiles", error), bytes_and_error(runs, "paper", error));
    if (!ratio) return;
    findings.push_back(
        {key, ratio->ratio,
         "At an equal error as displayed " + when + ", the paper's principal components take " +
             (ratio->at_least ? "at least " : "") + written(ratio->ratio, Unit::Number) + " times the bytes of tiles" +
             (ratio->at_least ? " (with most vectors they are still worse than the coarsest tiles)" : "")});
}

std::vector<Finding> findings(const Uncompressed& day, const std::vector<std::size_t>& intervals,
                              const std::vector<RunResult>& runs) {
    std::vector<Finding> all;
    const double whole_day = kDayFrames * 6.0 * double(day.pixels.size());
    const double ratio = whole_day / *runs.front().value("file_bytes");
    all.push_back({"frames_bytes", whole_day,
                   std::to_string(kDayFrames) + " frames of " + std::to_string(day.pixels.size()) +
                       " texels in half floats take " + written(whole_day, Unit::Bytes) + ", " +
                       written(ratio, Unit::Number) + " times the bytes of tiles as bakes keep them"});
    compare(runs, "displayed_worst", "paper_over_tiles_bytes", "in the worst hour", all);
    compare(runs, "displayed_sunlit", "paper_over_tiles_bytes_sunlit", "in the worst hour while the sun is up", all);
    all.push_back({"paper_frames", double(intervals.size()),
                   "The paper's test of intervals keeps " + std::to_string(intervals.size()) + " of " +
                       std::to_string(day.film.frames()) + " frames"});
    return all;
}

}  // namespace

StudyResult compare_lightmap_encodings(const BakeSettings& base, const Judges& judges, const Progress& progress) {
    BakeSettings settings = base;
    settings.parts = {"lightmap"}, settings.directional = false;
    const BakeInput input(judges.level.loaded.scene, settings);
    if (!input.plan.lightmap) throw Error("not compared", "the scene has no static surfaces to hold a lightmap");
    const auto part = [&](double from, double to) -> Progress {
        return [&progress, from, to](double done) { return !progress || progress(from + (to - from) * done); };
    };
    Uncompressed day;
    {
        SolvedDay solved(input, part(0.0, 0.4));
        day.rows = lightmap_rows(solved, {part(0.4, 0.45), 0.0, 1.0});
    }
    make_film(judges.level.light, day);
    if (day.pixels.empty()) throw Error("not compared", "no texel lies in the open");
    const DisplayedTruth truth = display_truth(day);
    const std::vector<Vec2> uvs =
        lightmap_uvs(day.rows.shape.corner_uvs, judges.level.loaded.scene, judges.surface.points);
    const std::vector<std::size_t> intervals = paper_intervals(day.film.frames(), noticeable(day, truth));

    StudyResult result;
    const std::vector<LightmapEncoding> sweep = lightmap_encodings();
    for (const LightmapEncoding& point : sweep) {
        RunResult run{.method = "encodings", .axis = point.axis, .name = point.name};
        const Encoded encoded = std::holds_alternative<LightmapSettings>(point.settings)
                                    ? encode(day, truth, std::get<LightmapSettings>(point.settings))
                                    : encode(day, truth, std::get<PaperSettings>(point.settings), intervals);
        run.values["file_bytes"] = encoded.bytes;
        judge_points(day, uvs, judges, encoded, run);
        judge_display(day, truth, encoded, settings.light, run);
        result.runs.push_back(std::move(run));
        if (!part(0.5, 1.0)(double(result.runs.size()) / double(sweep.size()))) throw Interrupted();
    }
    result.findings = findings(day, intervals, result.runs);
    return result;
}

}  // namespace daylit

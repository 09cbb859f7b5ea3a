// daylit compare A B: how far two pictures, or two files of measured points, are apart.
#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>

#include "demo/commands.h"
#include "demo/output.h"
#include "engine/base/compare.h"
#include "engine/base/error.h"
#include "engine/base/exposure.h"
#include "engine/base/point_rows.h"

namespace daylit {
namespace {

struct CompareOptions {
    std::string a, b, output;
    bool json = false;
};

enum class Kind { Linear, Displayed, Points };

Kind kind_of(const std::filesystem::path& path) {
    std::string extension = path.extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(), [](unsigned char c) { return std::tolower(c); });
    if (extension == ".csv") return Kind::Points;
    for (const char* linear : {".exr", ".hdr", ".pfm", ".tif", ".tiff"}) {
        if (extension == linear) return Kind::Linear;
    }
    return Kind::Displayed;
}

/// JSON has no infinity and no NaN: ratios to a mean of zero are null.
nlohmann::ordered_json number(double value) {
    return std::isfinite(value) ? nlohmann::ordered_json(value) : nlohmann::ordered_json(nullptr);
}

double mean_luminance(const Image& image) {
    double sum = 0;
    for (const Rgb& pixel : image.pixels) sum += double(luminance(pixel));
    return sum / double(image.pixels.size());
}

void print(const nlohmann::ordered_json& measures) {
    for (const auto& [name, value] : measures.items()) {
        if (value.is_string()) {
            std::printf("%-16s %s\n", name.c_str(), value.get<std::string>().c_str());
        } else if (value.is_null()) {
            std::printf("%-16s undefined\n", name.c_str());
        } else if (value.is_number_integer()) {
            std::printf("%-16s %lld\n", name.c_str(), value.get<long long>());
        } else {
            std::printf("%-16s %.6g\n", name.c_str(), value.get<double>());
        }
    }
}

nlohmann::ordered_json compare_points(const CompareOptions& options) {
    const PointRows a = read_point_rows(options.a), b = read_point_rows(options.b);
    for (const auto& [rows, file] : {std::pair(&a, &options.a), std::pair(&b, &options.b)}) {
        if (!rows->measured) throw Error(*file, "has no r,g,b; measure it first with 'daylit points --in'");
    }
    if (a.rows.size() != b.rows.size()) {
        throw Error(options.b, "has " + std::to_string(b.rows.size()) + " points, " + options.a + " has " +
                                   std::to_string(a.rows.size()) + "; measure both at the same points");
    }
    std::vector<Rgb> values_a, values_b;
    for (std::size_t i = 0; i < a.rows.size(); ++i) {
        const float size = std::max(1.0f, glm::length(a.rows[i].position));
        if (!(glm::distance(a.rows[i].position, b.rows[i].position) <= 1e-4f * size)) {
            throw Error(options.b, "row " + std::to_string(i + 1) + " is at another place than in " + options.a +
                                       "; measure both at the same points");
        }
        values_a.push_back(a.rows[i].value);
        values_b.push_back(b.rows[i].value);
    }
    const Differences d = differences(values_a, values_b);
    return {{"kind", "points"},          {"count", a.rows.size()},    {"rmse", number(d.rmse)},
            {"nrmse", number(d.nrmse)},  {"bias", number(d.bias)},    {"p95", number(d.p95)},
            {"max_abs", number(d.max_abs)}, {"nan_count", d.nan_count}};
}

nlohmann::ordered_json compare_images(const CompareOptions& options, Kind kind) {
    const Image a = read_image(options.a), b = read_image(options.b);
    if (a.width != b.width || a.height != b.height) {
        throw Error(options.b, "is " + std::to_string(b.width) + " x " + std::to_string(b.height) + ", " + options.a +
                                   " is " + std::to_string(a.width) + " x " + std::to_string(a.height) +
                                   "; take both at one --size");
    }
    const Differences d = differences(a.pixels, b.pixels);
    const bool linear = kind == Kind::Linear;
    const double ev = linear ? auto_ev(b) : 0.0;
    const Image shown_a = linear ? tonemap(a, ev) : a, shown_b = linear ? tonemap(b, ev) : b;
    const DisplayedDifferences shown = displayed_differences(shown_a, shown_b);
    if (!options.output.empty()) write_image(options.output, difference_image(shown_a, shown_b, shown.flip));

    const double peak = linear ? d.largest : 1.0;
    nlohmann::ordered_json measures = {{"kind", linear ? "linear" : "displayed"},
                                       {"width", a.width},
                                       {"height", a.height},
                                       {"mean_a", number(mean_luminance(a))},
                                       {"mean_b", number(mean_luminance(b))},
                                       {"rmse", number(d.rmse)},
                                       {"nrmse", number(d.nrmse)},
                                       {"bias", number(d.bias)},
                                       {"mse", number(d.mse)},
                                       {"psnr", number(10.0 * std::log10(peak * peak / d.mse))},
                                       {"p95", number(d.p95)},
                                       {"max_abs", number(d.max_abs)},
                                       {"max_abs_8bit", shown.max_abs_8bit},
                                       {"nan_count", d.nan_count},
                                       {"flip_mean", shown.flip_mean},
                                       {"flip_p95", shown.flip_p95},
                                       {"yee_failed", shown.yee_failed},
                                       {"yee_failed_oiio", shown.yee_failed_oiio}};
    if (linear) measures["ev"] = ev;
    return measures;
}

void compare(const CompareOptions& options) {
    const Kind kind_a = kind_of(options.a), kind_b = kind_of(options.b);
    if (kind_a != kind_b) {
        throw Error(options.b, "and " + options.a +
                                   " are of different kinds; compare two linear images (.exr), two displayed ones "
                                   "(.png) or two files of points (.csv)");
    }
    if (kind_a == Kind::Points && !options.output.empty()) {
        throw UsageError("-o", "a difference image is made of two images, not of points");
    }
    if (!options.output.empty()) {
        check_output(options.output, {".png", ".exr"});
        check_apart(options.output, {options.a, options.b});
    }
    const nlohmann::ordered_json measures =
        kind_a == Kind::Points ? compare_points(options) : compare_images(options, kind_a);
    if (options.json) {
        std::printf("%s\n", measures.dump(2).c_str());
    } else {
        print(measures);
    }
}

}  // namespace

void add_compare(CLI::App& app) {
    CLI::App* command = app.add_subcommand("compare", "How far A is from the reference B: images or files of points");
    const auto options = std::make_shared<CompareOptions>();
    command->add_option("A", options->a, "picture (.exr linear, .png as displayed) or points with light (.csv)")->required();
    command->add_option("B", options->b, "the reference, of the same kind and size")->required();
    command->add_option("-o,--output", options->output, "A, B and their FLIP difference beside each other, .png or .exr");
    command->add_flag("--json", options->json, "the measures as JSON on stdout");
    command->footer(
        "rmse, mse, max_abs: over all channels of linear values (a .png decoded to linear light). nrmse and p95 are\n"
        "relative to the mean of B; bias is mean(A)/mean(B) - 1 and has no value where B is black: mean_a and mean_b "
        "are the\n"
        "mean luminances; psnr's peak is the largest value of B (1 for .png).\n"
        "flip_*: LDR-FLIP at 67 pixels per degree, both displayed at the automatic exposure of B. yee_failed: pixels\n"
        "told apart by Yee's metric; yee_failed_oiio: by OpenImageIO's, which overlooks differences of lightness.");
    command->callback([options] { compare(*options); });
}

}  // namespace daylit

#include "demo/report/page.h"

#include <algorithm>

#include "demo/parse.h"
#include "demo/report/chart.h"

namespace daylit {
namespace {

// Series colours after Okabe and Ito, told apart by colour-blind eyes too.
constexpr const char* kStyle = R"(
:root { --ink: #1d2329; --soft: #66707a; --rule: #dfe3e8; --paper: #ffffff; --back: #f4f5f7;
  --s0: #0072b2; --s1: #d55e00; --s2: #009e73; --s3: #b05b97; --s4: #b58900; --s5: #56b4e9; --s6: #7a5195; --s7: #555f69;
  --s8: #8a5a2b; --s9: #a3283c; }
@media (prefers-color-scheme: dark) { :root { --ink: #e4e8ec; --soft: #9aa5b1; --rule: #323a43; --paper: #1b2026; --back: #14181c;
  --s0: #4aa8e0; --s1: #f08a4b; --s2: #2fc79b; --s3: #d68bc0; --s4: #e0b64a; --s5: #8ccdf2; --s6: #b294d1; --s7: #a7b1bb;
  --s8: #c99a6b; --s9: #e0717f; } }
* { box-sizing: border-box; }
body { margin: 0; background: var(--back); color: var(--ink); font: 15px/1.5 system-ui, "Segoe UI", Helvetica, Arial, sans-serif; }
main { max-width: 1320px; margin: 0 auto; padding: 32px 24px 64px; }
h1 { font-size: 28px; line-height: 1.2; margin: 0 0 8px; font-weight: 650; letter-spacing: -0.01em; }
h2 { font-size: 21px; margin: 0 0 4px; font-weight: 620; }
h2::first-letter { text-transform: uppercase; }
h3 { font-size: 15px; margin: 24px 0 8px; font-weight: 620; }
p { margin: 4px 0; max-width: 80ch; }
.soft { color: var(--soft); }
section { background: var(--paper); border: 1px solid var(--rule); border-radius: 10px; padding: 24px; margin: 20px 0; }
.charts { display: grid; grid-template-columns: repeat(auto-fit, minmax(420px, 1fr)); gap: 16px; margin: 16px 0 0; }
svg { width: 100%; height: auto; display: block; }
.wide { overflow-x: auto; }
table { border-collapse: collapse; width: 100%; font-variant-numeric: tabular-nums; font-size: 13px; }
th { text-align: right; font-weight: 560; color: var(--soft); padding: 6px; border-bottom: 1px solid var(--rule); white-space: nowrap; }
td { text-align: right; padding: 5px 6px; border-bottom: 1px solid var(--rule); white-space: nowrap; }
th:first-child, td:first-child, td.words { text-align: left; }
tr.base td { font-weight: 600; }
td.words { white-space: normal; color: var(--soft); }
.legend { display: flex; flex-wrap: wrap; gap: 4px 18px; margin: 10px 0 0; padding: 0; list-style: none; font-size: 13.5px; }
.legend svg { width: 26px; height: 12px; display: inline-block; vertical-align: baseline; margin-right: 6px; }
.pictures { display: grid; grid-template-columns: repeat(3, 1fr); gap: 10px; margin: 8px 0 20px; }
figure { margin: 0; }
figure img { width: 100%; display: block; border-radius: 6px; background: #000; }
figcaption { font-size: 13px; color: var(--soft); margin-top: 4px; }
text { font: 11px system-ui, "Segoe UI", Helvetica, Arial, sans-serif; fill: var(--soft); }
text.title { font-size: 13.5px; font-weight: 620; fill: var(--ink); }
text.label { fill: var(--ink); }
text.middle { text-anchor: middle; } text.end { text-anchor: end; }
.grid { stroke: var(--rule); stroke-width: 1; }
.floor { stroke: var(--soft); stroke-width: 1; stroke-dasharray: 2 3; }
.front-line { fill: none; stroke: var(--ink); stroke-width: 7; stroke-opacity: 0.11; stroke-linejoin: round; stroke-linecap: round; }
.line { fill: none; stroke-width: 1.3; stroke-opacity: 0.55; }
.other { stroke-dasharray: 5 4; }
circle { stroke-width: 1.8; }
circle.beaten { fill: var(--paper); }
circle.other { fill: var(--paper); stroke-dasharray: none; }
)";

std::string style() {
    std::string text = kStyle;
    for (std::size_t s = 0; s < kSeriesLooks; ++s) {
        const std::string n = std::to_string(s);
        text += ".s" + n + " { stroke: var(--s" + n + "); } circle.best.s" + n + " { fill: var(--s" + n + "); }\n";
    }
    return text;
}

/// The axes of a method in the order of their first run, without the base.
std::vector<std::string> axes(const ReportedMethod& method) {
    std::vector<std::string> names;
    for (const RunResult& run : method.runs)
        if (run.axis != "base" && std::find(names.begin(), names.end(), run.axis) == names.end())
            names.push_back(run.axis);
    return names;
}

void add_point(ChartSeries& series, const RunResult& run, const char* x, const char* y) {
    const auto at = run.value(x), error = run.value(y);
    if (at && error) series.points.push_back({*at, *error, run.name});
}

/// One series an axis; the base, which lies on every axis, is a point of each but competes once.
std::vector<ChartSeries> series_of(const ReportedMethod& method, const char* x, const char* y) {
    std::vector<ChartSeries> all;
    for (const std::string& axis : axes(method)) {
        ChartSeries& series = all.emplace_back(ChartSeries{axis, {}, true});
        for (const RunResult& run : method.runs)
            if (run.axis == axis || run.axis == "base") add_point(series, run, x, y);
    }
    if (all.empty()) {
        all.push_back({"base", {}, true});
        for (const RunResult& run : method.runs) add_point(all.back(), run, x, y);
    }
    return all;
}

/// The path tracer answering for all that the base run's bake holds: measured error, time by its measured rate.
ChartSeries traced_alike(const Report& report, const ReportedMethod& method) {
    ChartSeries series{"path tracer, every place and hour apart", {}, false};
    const auto answers = method.runs.empty() ? std::nullopt : method.runs.front().value("answers");
    for (const RunResult& run : report.traced) {
        const auto each = run.value("look_up_seconds"), error = run.value("nrmse");
        if (run.axis == (method.in_space ? "space" : "surface") && answers && each && error)
            series.points.push_back({*each * *answers, *error, run.name});
    }
    return series;
}

ChartSeries traced_pictures(const Report& report) {
    ChartSeries series{"path tracer", {}, false};
    for (const RunResult& run : report.traced)
        if (run.axis == "pictures") add_point(series, run, "frame_seconds", "flip_mean");
    return series;
}

std::string charts(const Report& report, const ReportedMethod& method) {
    struct Kind {
        const char *title, *x, *x_label, *y, *y_label;
        Unit x_unit, y_unit;
    };
    const Kind kinds[] = {
        {"Error against bake time", "bake_seconds", "bake, wall time", "nrmse", "nrmse", Unit::Seconds, Unit::Share},
        {"Error against file size", "file_bytes", "baked file", "nrmse", "nrmse", Unit::Bytes, Unit::Share},
        {"Error against peak memory", "peak_bytes", "peak memory of the bake", "nrmse", "nrmse", Unit::Bytes,
         Unit::Share},
        {"Error against look-up time", "look_up_seconds", "one look-up, processor time", "nrmse", "nrmse",
         Unit::Seconds, Unit::Share},
        {"Error against the gather itself, against bytes", "file_bytes", "bytes", "gather_nrmse",
         "nrmse against the gather", Unit::Bytes, Unit::Share},
        {"Error against the gather itself, against look-up time", "look_up_seconds", "one look-up, processor time",
         "gather_nrmse", "nrmse against the gather", Unit::Seconds, Unit::Share},
        {"Worst hour as displayed against bytes", "file_bytes", "bytes", "displayed_worst", "RMS of sRGB values",
         Unit::Bytes, Unit::Share},
        {"Worst sunlit hour as displayed against bytes", "file_bytes", "bytes", "displayed_sunlit",
         "RMS of sRGB values", Unit::Bytes, Unit::Share},
        {"FLIP against frame time", "frame_seconds", "frame, wall time", "flip_mean", "FLIP", Unit::Seconds,
         Unit::Number},
        {"FLIP against bake time", "bake_seconds", "bake, wall time", "flip_mean", "FLIP", Unit::Seconds, Unit::Number},
    };
    std::string out;
    for (const Kind& kind : kinds) {
        ScatterChart chart{
            kind.title, kind.x_label, kind.y_label, kind.x_unit, kind.y_unit, series_of(method, kind.x, kind.y), {},
            {}};
        const bool points = kind.y == std::string("nrmse");
        if (points) chart.floor = method.standard_error, chart.floor_label = "standard error of the reference";
        if (points && kind.x == std::string("bake_seconds")) chart.series.push_back(traced_alike(report, method));
        if (!points && kind.x == std::string("frame_seconds") && !chart.series.front().points.empty())
            chart.series.push_back(traced_pictures(report));
        out += svg(chart);
    }
    return out.empty() ? std::string() : "<div class=\"charts\">\n" + out + "</div>\n";
}

std::string legend(const ReportedMethod& method) {
    std::string out = "<ul class=\"legend\">\n";
    std::vector<std::string> names = axes(method);
    if (names.empty()) names = {"base"};
    const auto item = [&](const std::string& marks, const std::string& what) {
        out += "<li><svg viewBox=\"0 0 26 12\">" + marks + "</svg>" + escaped(what) + "</li>\n";
    };
    std::size_t s = 0;
    for (; s < names.size(); ++s) {
        const std::string look = "s" + std::to_string(s % kSeriesLooks);
        item("<path class=\"" + look + " line\" d=\"M1 6L25 6\"/><circle class=\"" + look +
                 " beaten\" cx=\"13\" cy=\"6\" r=\"4.5\"/>",
             names[s]);
    }
    const std::string other = "s" + std::to_string(s % kSeriesLooks);
    item("<path class=\"" + other + " line other\" d=\"M1 6L25 6\"/><circle class=\"" + other +
             " other\" cx=\"13\" cy=\"6\" r=\"4.5\"/>",
         "path tracer");
    item("<path class=\"front-line\" d=\"M3 6L23 6\"/><circle class=\"best s0\" cx=\"13\" cy=\"6\" r=\"4.5\"/>",
         "Pareto front: nothing here is better in both");
    return out + "</ul>\n";
}

std::string head(const std::vector<const Measure*>& columns) {
    std::string out = "<tr><th>setting</th>";
    for (const Measure* m : columns) out += "<th title=\"" + escaped(m->what) + "\">" + escaped(m->label) + "</th>";
    return out + "</tr>\n";
}

std::vector<const Measure*> columns_of(const std::vector<RunResult>& runs, bool glance) {
    std::vector<const Measure*> columns;
    for (const Measure& m : measures())
        if ((m.glance || !glance) &&
            std::any_of(runs.begin(), runs.end(), [&](const RunResult& run) { return run.value(m.key).has_value(); }))
            columns.push_back(&m);
    return columns;
}

std::string row(const RunResult& run, const std::string& name, const std::vector<const Measure*>& columns) {
    std::string out =
        std::string(run.axis == "base" ? "<tr class=\"base\">" : "<tr>") + "<td>" + escaped(name) + "</td>";
    if (!run.failure.empty())
        return out + "<td class=\"words\" colspan=\"" + std::to_string(columns.size()) + "\">" + escaped(run.failure) +
               "</td></tr>\n";
    for (const Measure* m : columns) {
        const auto value = run.value(m->key);
        out += "<td>" + (value ? escaped(written(*value, m->unit)) : "&#8211;") + "</td>";
    }
    return out + "</tr>\n";
}

/// glance: few columns, and lines that name their method
std::string table(const std::vector<RunResult>& runs, bool glance) {
    const std::vector<const Measure*> columns = columns_of(runs, glance);
    std::string out = "<div class=\"wide\"><table>\n<thead>" + head(columns) + "</thead>\n<tbody>\n";
    for (const RunResult& run : runs) out += row(run, glance ? run.method + ", " + run.name : run.name, columns);
    return out + "</tbody></table></div>\n";
}

std::string section(const Report& report, const ReportedMethod& method) {
    std::string out =
        "<section>\n<h2>" + escaped(method.name) + "</h2>\n<p class=\"soft\">" + escaped(method.about) + "</p>\n";
    if (!method.runs.empty() && !method.runs.front().note.empty())
        out += "<p class=\"soft\">Base: " + escaped(method.runs.front().note) + ".</p>\n";
    for (const Finding& finding : method.findings) out += "<p>" + escaped(finding.text) + ".</p>\n";
    const std::string drawn = charts(report, method);
    if (!drawn.empty()) out += legend(method) + drawn;
    return out + "<h3>All settings</h3>\n" + table(method.runs, false) + "</section>\n";
}

std::string figure(const std::string& file, const std::string& caption) {
    return "<figure><a href=\"" + escaped(file) + "\"><img loading=\"lazy\" src=\"" + escaped(file) + "\" alt=\"" +
           escaped(caption) + "\"/></a><figcaption>" + escaped(caption) + "</figcaption></figure>\n";
}

std::string pictures(const Report& report) {
    std::string out = "<section>\n<h2>Pictures beside their differences</h2>\n";
    if (!report.no_pictures.empty())
        return out + "<p>No pictures and no frame times: " + escaped(report.no_pictures) + ".</p>\n</section>\n";
    out +=
        "<p class=\"soft\">Left the reference, then the method with its base settings at the same exposure, then where "
        "FLIP sees a "
        "difference, from black (none) to pale yellow.</p>\n";
    for (const ReportedPicture& reference : report.pictures)
        for (const ReportedMethod& method : report.methods) {
            if (!method.in_pictures || method.runs.empty()) continue;
            for (const PictureResult& p : method.runs.front().pictures) {
                if (p.view != reference.view || p.hour != reference.hour || p.file.empty()) continue;
                const auto value = [&](const char* key, Unit unit) {
                    const auto found = p.values.find(key);
                    return found == p.values.end() ? std::string("undefined") : written(found->second, unit);
                };
                out += "<h3>" + escaped(p.view) + ", " + clock_text(p.hour) + "</h3>\n<div class=\"pictures\">\n" +
                       figure(reference.reference, "reference, standard error of a pixel " +
                                                       written(reference.standard_error, Unit::Share)) +
                       figure(p.file, method.name + ", nrmse " + value("nrmse", Unit::Share) + ", bias " +
                                          value("bias", Unit::Share)) +
                       figure(p.difference, "FLIP " + value("flip_mean", Unit::Number) + ", visible by Yee " +
                                                value("yee_share", Unit::Share)) +
                       "</div>\n";
            }
        }
    return out + "</section>\n";
}

std::string glossary() {
    std::string out = "<section>\n<h2>What is measured</h2>\n<div class=\"wide\"><table><tbody>\n";
    for (const Measure& m : measures())
        out += "<tr><td>" + escaped(m.label) + "</td><td class=\"words\">" + escaped(m.what) + "</td></tr>\n";
    return out + "</tbody></table></div>\n</section>\n";
}

}  // namespace

std::string page(const Report& report) {
    std::string out =
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\"/>\n"
        "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\"/>\n<title>daylit report: " +
        escaped(report.scene) + "</title>\n<style>" + style() + "</style>\n</head>\n<body>\n<main>\n<h1>" +
        escaped(report.scene) + "</h1>\n<p>" + escaped(report.settings) + "</p>\n<p class=\"soft\">" +
        escaped(report.machine) + (report.driver.empty() ? "" : "; drawn by " + escaped(report.driver)) + "</p>\n";
    std::vector<RunResult> glance;
    for (const ReportedMethod& method : report.methods)
        if (!method.runs.empty()) glance.push_back(method.runs.front());
    for (RunResult run : report.traced) {
        run.name += run.axis == "pictures" ? " a pixel" : " a point (" + run.axis + ")";
        run.axis.clear();
        glance.push_back(run);
    }
    out += "<section>\n<h2>At a glance</h2>\n" + table(glance, true) + "</section>\n";
    for (const ReportedMethod& method : report.methods) out += section(report, method);
    return out + pictures(report) + glossary() + "</main>\n</body>\n</html>\n";
}

}  // namespace daylit

// The report's parts: fronts, scales, charts, tables, what is kept between two starts.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "demo/report/chart.h"
#include "demo/report/equal_error.h"
#include "demo/report/finished.h"
#include "demo/report/page.h"
#include "demo/report/spent.h"
#include "demo/report/sweep_runner.h"
#include "engine/base/error.h"
#include "tests/support/gltf_builder.h"

namespace daylit {
namespace {

TEST(ParetoFront, KeepsWhatNothingBeats) {
    const std::vector<ChartPoint> points = {{4, 1, "d"},    {1, 4, "a"},      {2, 2, "b"},     {3, 3, "beaten"},
                                            {2, 2, "twin"}, {1, 5, "beaten"}, {5, 1, "beaten"}};
    EXPECT_EQ(pareto_front(points), (std::vector<std::size_t>{1, 2, 0}));
    EXPECT_TRUE(pareto_front({}).empty());
    EXPECT_EQ(pareto_front(std::vector<ChartPoint>{{7, 7, "alone"}}), (std::vector<std::size_t>{0}));
}

// Errors fall with the cost to the power -1 and -1/2: 100 and 1000 of ours are as good as 10000 and 1000000.
TEST(EqualError, IsReadOffBetweenPoints) {
    const std::vector<ChartPoint> ours = {{100, 0.01, ""}, {1000, 0.001, ""}, {2000, 0.5, "beaten"}};
    const std::vector<ChartPoint> other = {
        {1e3, 0.0316227766, ""}, {1e5, 0.00316227766, ""}, {1e7, 0.000316227766, ""}};
    const auto ratio = cost_at_equal_error(ours, other);
    ASSERT_TRUE(ratio);
    EXPECT_NEAR(ratio->ratio, std::sqrt(100.0 * 1000.0), 0.1);
    EXPECT_FALSE(ratio->at_least);
    EXPECT_EQ(ratio->reached, 2);
    EXPECT_EQ(ratio->of, 2);
}

TEST(EqualError, SaysWhatItCanWhereNoErrorIsReachedByBoth) {
    const std::vector<ChartPoint> ours = {{100, 0.01, ""}, {200, 0.005, ""}}, worse = {{50, 0.9, ""}, {700, 0.02, ""}};
    const auto ratio = cost_at_equal_error(ours, worse);
    ASSERT_TRUE(ratio);
    EXPECT_NEAR(ratio->ratio, 7.0, 1e-9);
    EXPECT_TRUE(ratio->at_least);
    EXPECT_FALSE(cost_at_equal_error(worse, ours));
    EXPECT_FALSE(cost_at_equal_error({}, ours));
    EXPECT_FALSE(cost_at_equal_error(ours, std::vector<ChartPoint>{{0, 0.1, ""}, {10, NAN, ""}}));
}

TEST(LogScale, MapsItsEndsAndEqualRatiosToEqualSteps) {
    const LogScale scale{0.1, 1000.0, 50.0, 450.0};
    EXPECT_NEAR(scale(0.1), 50.0, 1e-9);
    EXPECT_NEAR(scale(1000.0), 450.0, 1e-9);
    EXPECT_NEAR(scale(10.0) - scale(1.0), scale(100.0) - scale(10.0), 1e-9);
    const LogScale upwards{1.0, 10.0, 300.0, 20.0};
    EXPECT_GT(upwards(2.0), upwards(3.0));
}

TEST(LogScale, TicksAreRoundAscendingAndWithin) {
    for (const auto& [low, high] : {std::pair(0.013, 0.09), {0.5, 60.0}, {3e-9, 2.0}, {1e-20, 1e20}, {1.2, 1.9}}) {
        const std::vector<double> ticks = LogScale{low, high, 0, 1}.ticks();
        EXPECT_LE(ticks.size(), 14u) << low;
        EXPECT_GE(ticks.size(), 2u) << low;
        for (std::size_t i = 0; i < ticks.size(); ++i) {
            EXPECT_GE(ticks[i], low * (1 - 1e-6));
            EXPECT_LE(ticks[i], high * (1 + 1e-6));
            if (i > 0) {
                EXPECT_GT(ticks[i], ticks[i - 1]);
            }
            const double lead = ticks[i] / std::pow(10.0, std::floor(std::log10(ticks[i]) + 1e-9));
            EXPECT_NEAR(lead * 10.0, std::round(lead * 10.0), 1e-5) << lead;
        }
    }
    EXPECT_EQ((LogScale{0.4, 60.0, 0, 1}.ticks()), (std::vector<double>{0.5, 1, 2, 5, 10, 20, 50}));
}

TEST(LogScale, HoldsAllValuesAndIgnoresWhatItCannotShow) {
    const std::vector<double> values = {3.0, 0.0, -1.0, 70.0, INFINITY, NAN};
    const LogScale scale = scale_for(values, 0, 100);
    EXPECT_LT(scale.low, 3.0);
    EXPECT_GT(scale.high, 70.0);
    EXPECT_LT(scale.high, 1000.0);
    const LogScale one = scale_for(std::vector<double>{5.0}, 0, 100);
    EXPECT_GE(one.high / one.low, 1.99);
    EXPECT_NEAR(one(5.0), 50.0, 1e-9);
    const LogScale none = scale_for({}, 0, 100);
    EXPECT_GT(none.high, none.low);
}

std::size_t count(const std::string& text, const std::string& part) {
    std::size_t found = 0;
    for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++found;
    return found;
}

TEST(Chart, DrawsEveryPointThatCanBeDrawnAndMarksTheFront) {
    ScatterChart chart;
    chart.title = "a < b & \"c\"";
    chart.series = {
        {"rays", {{1, 0.1, "one"}, {2, 0.05, "two"}, {3, 0.2, "worse"}, {0, 1, "zero"}, {1, NAN, "none"}}, true},
        {"path tracer", {{0.1, 0.01, "compared"}}, false}};
    const std::string drawn = svg(chart);
    EXPECT_EQ(count(drawn, "<circle"), 4u);
    EXPECT_EQ(count(drawn, "best\""), 2u);  // the path tracer's point does not compete
    EXPECT_EQ(count(drawn, "beaten\""), 1u);
    EXPECT_EQ(count(drawn, "front-line"), 1u);
    EXPECT_NE(drawn.find("a &lt; b &amp; &quot;c&quot;"), std::string::npos);
    EXPECT_EQ(drawn.find("nan"), std::string::npos);
    EXPECT_EQ(drawn.find("inf"), std::string::npos);
    EXPECT_TRUE(svg(ScatterChart{}).empty());
}

TEST(Written, ThreeDigitsAndTheUnit) {
    EXPECT_EQ(written(0.0312, Unit::Share), "3.12 %");
    EXPECT_EQ(written(0.0042, Unit::Seconds), "4.2 ms");
    EXPECT_EQ(written(1.07e-7, Unit::Seconds), "107 ns");
    EXPECT_EQ(written(7200, Unit::Seconds), "2 h");
    EXPECT_EQ(written(1.25e6, Unit::Bytes), "1.25 MB");
    EXPECT_EQ(written(0, Unit::Bytes), "0 B");
    EXPECT_EQ(written(NAN, Unit::Share), "undefined");
}

RunResult sample_run(const std::string& name, double error) {
    RunResult run{.method = "lightmap", .axis = name == "base" ? "base" : "rays", .name = name};
    run.values = {{"nrmse", error}, {"answers", 1000.0}, {"bake_seconds", 2.0}};
    return run;
}

TEST(RunResult, SurvivesJsonAndBecomesCsv) {
    RunResult run = sample_run("rays, \"many\"", 0.125);
    run.pictures = {{"view", 6.5, {{"flip_mean", 0.25}}, "a.png", "b.png"}};
    const RunResult back = nlohmann::json::parse(nlohmann::json(run).dump()).get<RunResult>();
    EXPECT_EQ(back.name, run.name);
    EXPECT_EQ(back.values, run.values);
    EXPECT_EQ(back.pictures.at(0).values, run.pictures[0].values);
    const std::string csv = csv_text(std::vector<RunResult>{run});
    EXPECT_EQ(count(csv, "\n"), 2u);
    EXPECT_NE(csv.find("\"rays, \"\"many\"\"\",0.125"), std::string::npos) << csv;
}

TEST(Finished, FindsOnlyWhatWasKeptUnderTheSameKey) {
    const test::TemporaryFolder folder;
    const Finished finished(folder / "runs", {{"spp", 4}});
    EXPECT_FALSE(finished.find("a"));
    finished.keep("a", sample_run("base", 0.5));
    ASSERT_TRUE(finished.find("a"));
    EXPECT_EQ(finished.find("a")->get<RunResult>().values.at("nrmse"), 0.5);
    EXPECT_FALSE(Finished(folder / "runs", {{"spp", 8}}).find("a"));
    std::ofstream(finished.path("a", ".json")) << "{ broken";
    EXPECT_FALSE(finished.find("a"));
    std::ofstream(folder / "file") << "in the way";
    EXPECT_THROW(Finished(folder / "file", {}), Error);
}

TEST(Spent, SeesMemoryThatIsGoneAgain) {
    const Spent spent = measure([] {
        std::vector<char> memory(std::size_t(64) << 20, 1);
        EXPECT_EQ(memory.back(), 1);
    });
    EXPECT_GT(spent.processor_seconds, 0.0);
    if (spent.peak_bytes == 0.0) GTEST_SKIP() << "NOT RUN: no /proc/self/clear_refs here";
    EXPECT_GT(spent.peak_bytes, 60e6);
    EXPECT_LT(spent.peak_bytes, 120e6);
}

TEST(TracedAlike, ErrorFallsWithTheRootOfThePaths) {
    std::vector<RunResult> runs = {sample_run("base", 0.1)};
    RunResult traced{.method = "path tracer", .axis = "surface", .name = "16 paths"};
    traced.values = {{"nrmse", 0.2}, {"look_up_seconds", 0.5}};
    compare_with_traced(runs, {traced});
    EXPECT_NEAR(runs[0].values.at("traced_alike_seconds"), 1000.0 * 0.5 * 4.0, 1e-9);
}

TEST(Page, SaysWhyThingsAreMissing) {
    Report report;
    report.scene = "<level>";
    report.no_pictures = "no driver";
    report.methods = {
        {"lightmap", "about", false, true, 0.001, {sample_run("base", 0.1), sample_run("rays x 2", 0.05)}}};
    report.methods[0].runs.push_back(
        {.method = "lightmap", .axis = "texels", .name = "texels x 9", .failure = "too many"});
    const std::string html = page(report);
    for (const char* said : {"&lt;level&gt;", "no driver", "too many", "rays x 2"})
        EXPECT_NE(html.find(said), std::string::npos) << said;
    EXPECT_EQ(html.find("http://"), html.find("http://www.w3.org/2000/svg"));  // nothing to fetch
}

}  // namespace
}  // namespace daylit

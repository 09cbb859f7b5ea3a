// The paper's scheme against closed forms: films of known rank, known variances, known changes.
#include "gi/encode/paper_pca.h"

#include <gtest/gtest.h>
#include <tbb/task_arena.h>

#include <cmath>

#include "engine/base/random.h"

namespace daylit {
namespace {

constexpr std::size_t kFrames = 25, kPixels = 3000;

/// Frames as sums of `rank` components that are as strong as asked, with curves that are orthogonal over the frames.
struct Film {
    std::vector<Rgb> rows;
    std::vector<std::uint32_t> at;
    FilmRows film;
};

double curve(std::size_t r, std::size_t k) {  // the columns of a discrete cosine transform, orthonormal
    return std::sqrt(2.0 / double(kFrames)) * std::cos(kPi * (double(k) + 0.5) * double(r + 1) / double(kFrames));
}

Film film_of(const std::vector<double>& strengths) {
    Film made;
    Random random(9, 0, 0);
    for (std::size_t p = 0; p < kPixels; ++p) {
        made.at.push_back(std::uint32_t(p));
        for (std::size_t r = 0; r <= strengths.size(); ++r) made.rows.push_back(Rgb(0.0f));
        for (int c = 0; c < 3; ++c) made.rows[p * (strengths.size() + 1)][c] = 1.0f;
    }
    // Patterns that are orthogonal over pixels and channels and have no mean: squares of plus and minus one.
    for (std::size_t r = 0; r < strengths.size(); ++r)
        for (std::size_t p = 0; p < kPixels; ++p)
            made.rows[p * (strengths.size() + 1) + r + 1] = Rgb(float(strengths[r]) * (p >> r & 1 ? 1.0f : -1.0f));
    made.film.components = strengths.size() + 1;
    made.film.rows = made.rows, made.film.at = made.at;
    for (std::size_t k = 0; k < kFrames; ++k) made.film.hours.push_back(6.0 + 0.5 * double(k));
    for (std::size_t r = 0; r <= strengths.size(); ++r)
        for (int c = 0; c < 3; ++c)
            for (std::size_t k = 0; k < kFrames; ++k) made.film.weights.push_back(r == 0 ? 500.0 : curve(r - 1, k));
    return made;
}

double mean_square(const std::vector<Rgb>& a, const std::vector<Rgb>& b) {
    double sum = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i) sum += double(glm::dot(a[i] - b[i], a[i] - b[i]));
    return sum / (3.0 * double(a.size()));
}

TEST(PaperPca, gives_back_films_of_few_dimensions) {
    const Film made = film_of({200.0, 90.0, 30.0});
    const PaperPca pca = paper_pca(made.film, 10);
    EXPECT_EQ(pca.count(), 3u);
    for (std::size_t k = 0; k < kFrames; ++k)
        EXPECT_LT(std::sqrt(mean_square(pca.light(made.film.hours[k]), made.film.frame(k))), 0.5) << k;
}

TEST(PaperPca, leaves_out_what_the_variances_say) {
    const std::vector<double> strengths = {200.0, 90.0, 30.0, 12.0};
    const Film made = film_of(strengths);
    for (std::size_t vectors = 0; vectors < strengths.size(); ++vectors) {
        const PaperPca pca = paper_pca(made.film, vectors);
        ASSERT_EQ(pca.count(), vectors);
        double left = 0.0, wrong = 0.0;
        for (std::size_t r = 0; r < strengths.size(); ++r) {
            // Patterns of blocks that do not fit the pixels evenly are nearly orthogonal, not quite.
            EXPECT_NEAR(pca.variances[r], strengths[r] * strengths[r], 0.03 * strengths[r] * strengths[r]);
            if (r >= vectors) left += pca.variances[r];
        }
        for (std::size_t k = 0; k < kFrames; ++k)
            wrong += mean_square(pca.light(made.film.hours[k]), made.film.frame(k));
        EXPECT_NEAR(wrong, left, 0.001 * left) << vectors;
    }
}

TEST(PaperPca, is_straight_between_frames_and_held_outside) {
    const Film made = film_of({200.0, 90.0});
    const PaperPca pca = paper_pca(made.film, 10);
    const auto a = pca.light(made.film.hours[7]), b = pca.light(made.film.hours[8]);
    const auto between = pca.light(0.75 * made.film.hours[7] + 0.25 * made.film.hours[8]);
    for (std::size_t p = 0; p < kPixels; p += 97) EXPECT_NEAR(between[p].g, 0.75f * a[p].g + 0.25f * b[p].g, 1e-2);
    EXPECT_EQ(pca.light(0.0), pca.light(made.film.hours.front()));
    EXPECT_EQ(pca.light(24.0), pca.light(made.film.hours.back()));
}

TEST(PaperPca, some_pixels_alone) {
    const PaperPca pca = paper_pca(film_of({200.0, 90.0}).film, 10);
    const std::vector<std::uint32_t> which = {2999, 5, 5, 17};
    const auto all = pca.light(10.0), some = pca.of(which).light(10.0);
    ASSERT_EQ(some.size(), which.size());
    for (std::size_t i = 0; i < which.size(); ++i) EXPECT_EQ(some[i], all[which[i]]);
}

TEST(PaperPca, bytes_are_halves_of_scores_and_floats_of_frames) {
    const Film made = film_of({200.0, 90.0, 30.0});
    EXPECT_EQ(paper_pca(made.film, 2).bytes().size(), 2 * (3 * kPixels * 2) + kFrames * (8 + 4 + 2 * 4));
}

TEST(PaperPca, a_film_of_one_black_frame) {
    std::vector<Rgb> rows(5, Rgb(0.0f));
    const std::vector<std::uint32_t> at = {0, 1, 2, 3, 4};
    const FilmRows film{{12.0}, 1, rows, at, {1.0, 1.0, 1.0}};
    const PaperPca pca = paper_pca(film, 10);
    EXPECT_EQ(pca.count(), 0u);
    EXPECT_EQ(pca.light(12.0), rows);
}

TEST(PaperPca, same_bytes_for_any_number_of_threads) {
    const Film made = film_of({200.0, 90.0, 30.0, 12.0});
    Bytes one, three;
    tbb::task_arena(1).execute([&] { one = paper_pca(made.film, 3).bytes(); });
    tbb::task_arena(3).execute([&] { three = paper_pca(made.film, 3).bytes(); });
    EXPECT_EQ(one, three);
}

TEST(PaperIntervals, are_halved_where_light_changes) {
    // Nothing ever differs: the ends and the middle. Everything does: all frames.
    EXPECT_EQ(paper_intervals(17, [](auto, auto, auto) { return false; }), (std::vector<std::size_t>{0, 8, 16}));
    EXPECT_EQ(paper_intervals(17, [](auto, auto, auto) { return true; }).size(), 17u);
    // Light jumps between frames 5 and 6: intervals across the jump alone are split, down to it.
    const auto jump = [](std::size_t a, std::size_t b, std::size_t) { return a <= 5 && b >= 6; };
    EXPECT_EQ(paper_intervals(17, jump), (std::vector<std::size_t>{0, 4, 5, 6, 8, 16}));
    for (std::size_t few = 0; few < 3; ++few)
        EXPECT_EQ(paper_intervals(few, [](auto, auto, auto) { return true; }).size(), few);
}

TEST(FilmRows, some_frames_alone) {
    const Film made = film_of({200.0, 90.0});
    const std::vector<std::size_t> kept = {0, 11, 24};
    const FilmRows few = made.film.only(kept);
    ASSERT_EQ(few.frames(), 3u);
    for (std::size_t k = 0; k < kept.size(); ++k) {
        EXPECT_EQ(few.hours[k], made.film.hours[kept[k]]);
        EXPECT_EQ(few.frame(k), made.film.frame(kept[k]));
    }
}

TEST(FilmRows, are_played_straight_from_frame_to_frame) {
    const Film made = film_of({200.0, 90.0});
    const auto a = made.film.frame(3), b = made.film.frame(4);
    const auto between = made.film.played(0.5 * (made.film.hours[3] + made.film.hours[4]));
    for (std::size_t p = 0; p < kPixels; p += 97) EXPECT_NEAR(between[p].b, 0.5f * (a[p].b + b[p].b), 0.3f);  // halves
    EXPECT_EQ(made.film.bytes(), 6.0 * kPixels * kFrames);
}

}  // namespace
}  // namespace daylit

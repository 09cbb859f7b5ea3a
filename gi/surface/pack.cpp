#include "gi/surface/pack.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <span>
#include <utility>

#include "engine/baked/day_lightmap.h"
#include "engine/base/error.h"
#include "engine/scene/pose.h"
#define STB_RECT_PACK_IMPLEMENTATION
#define STBRP_STATIC
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#include <stb/stb_rect_pack.h>
#pragma GCC diagnostic pop

namespace daylit {
namespace {

constexpr int kTile = DayLightmap::kTileSide;
constexpr int kBinSide = 4 * kTile;                       // of what is filled with neighbours at a time
constexpr double kFewTexels = 2.0 * kBinSide * kBinSide;  // below which all are neighbours
constexpr double kFilled = 0.97;                          // of a bin's area that its first blocks are chosen to take
constexpr int kLookahead = 192;                           // blocks beyond those that are tried in the gaps

int whole_tiles(int texels) {
    return (texels + kTile - 1) / kTile * kTile;
}

double area(const Block& block) {
    return double(block.width) * double(block.height);
}

/// A rectangle of whole tiles and what lies in it.
class Bin {
  public:
    Bin(int width, int height) : width_(width), height_(height), nodes_(std::size_t(width), stbrp_node{}) {
        stbrp_init_target(&context_, width, height, nodes_.data(), width);
    }
    Bin(const Bin&) = delete;

    /// Those that find room get their places and are marked; returns whether all did.
    bool add(std::vector<Block>& blocks, std::span<const std::uint32_t> which, std::vector<bool>& placed) {
        std::vector<stbrp_rect> rects(which.size());
        for (std::size_t i = 0; i < which.size(); ++i) {
            rects[i] = {};
            rects[i].id = int(which[i]);
            rects[i].w = blocks[which[i]].width, rects[i].h = blocks[which[i]].height;
        }
        const bool all = stbrp_pack_rects(&context_, rects.data(), int(rects.size())) != 0;
        for (const stbrp_rect& r : rects) {
            if (!r.was_packed) continue;
            placed[std::size_t(r.id)] = true;
            blocks[std::size_t(r.id)].x = r.x, blocks[std::size_t(r.id)].y = r.y;
            used_ = std::max(used_, r.y + r.h);
        }
        return all;
    }
    int width() const { return width_; }
    int height() const { return height_; }
    int used() const { return used_; }  // of the height

  private:
    int width_, height_, used_ = 0;
    std::vector<stbrp_node> nodes_;
    stbrp_context context_;
};

/// All at once, in an atlas that is about square.
PackedSize pack_all(std::vector<Block>& blocks) {
    double sum = 0.0;
    int widest = 2;
    for (const Block& b : blocks) sum += area(b), widest = std::max(widest, b.width);
    std::vector<std::uint32_t> which(blocks.size());
    std::iota(which.begin(), which.end(), 0u);
    const int square = whole_tiles(int(std::ceil(std::sqrt(sum))));
    for (int width = blocks.size() == 1 ? widest : std::clamp(square, widest, std::max(kMaxAtlasSide, widest));
         widest <= kMaxAtlasSide; width = std::min(2 * width, kMaxAtlasSide)) {
        Bin bin(width, kMaxAtlasSide);
        std::vector<bool> placed(blocks.size());
        if (bin.add(blocks, which, placed)) return {width, std::max(bin.used(), 1)};
        if (width == kMaxAtlasSide) break;
    }
    refuse_atlas_size();
}

constexpr float kMorton = 65535.0f;  // steps along an axis

/// Its bits, at every third place. Sizes near a float's largest leave no number: 0.
std::uint64_t spread_bits(float x) {
    const std::uint32_t whole = x > 0.0f ? std::uint32_t(std::min(x, kMorton)) : 0u;
    std::uint64_t result = 0;
    for (int bit = 0; bit < 16; ++bit) result |= std::uint64_t(whole >> bit & 1u) << (3 * bit);
    return result;
}

/// Blocks in the order of Morton's curve through their places.
std::vector<std::uint32_t> by_place(const std::vector<Block>& blocks) {
    Bounds box;
    for (const Block& b : blocks) box.add(b.place);
    const Vec3 size = box.max - box.min;
    const float scale = kMorton / std::max({size.x, size.y, size.z, 1e-9f});
    std::vector<std::pair<std::uint64_t, std::uint32_t>> order;
    for (std::uint32_t i = 0; i < blocks.size(); ++i) {
        const Vec3 p = scale * (blocks[i].place - box.min);
        order.emplace_back(spread_bits(p.x) | spread_bits(p.y) << 1 | spread_bits(p.z) << 2, i);
    }
    std::sort(order.begin(), order.end());
    std::vector<std::uint32_t> result;
    for (const auto& [code, block] : order) result.push_back(block);
    return result;
}

/// Fills a new bin with blocks from the front of `waiting`, and its gaps with smaller ones from behind them; those
/// inside are moved to the front.
Block fill_bin(std::vector<Block>& blocks, std::span<std::uint32_t> waiting, std::vector<bool>& placed) {
    const Block& first = blocks[waiting[0]];
    const bool large = area(first) > 0.5 * kBinSide * kBinSide;
    const auto side = [&](int own) { return whole_tiles(large ? own : std::max(own, kBinSide)); };
    Bin bin(side(first.width), side(first.height));
    std::size_t count = 0;
    const double room = kFilled * bin.width() * bin.height();
    for (double sum = 0.0; count < waiting.size() && (count == 0 || sum + area(blocks[waiting[count]]) <= room);
         ++count)
        sum += area(blocks[waiting[count]]);
    bin.add(blocks, waiting.first(count), placed);
    const std::span<std::uint32_t> tried = waiting.first(std::min(waiting.size(), count + kLookahead));
    for (std::size_t i = 0; i < tried.size(); ++i)
        if (!placed[tried[i]]) bin.add(blocks, tried.subspan(i, 1), placed);
    std::stable_partition(tried.begin(), tried.end(), [&](std::uint32_t i) { return bool(placed[i]); });
    return {.width = bin.width(), .height = whole_tiles(bin.used())};
}

PackedSize pack_by_place(std::vector<Block>& blocks) {
    std::vector<std::uint32_t> order = by_place(blocks);
    std::vector<bool> placed(blocks.size());
    std::vector<Block> bins;
    std::vector<std::size_t> bin_of(blocks.size());
    for (std::size_t done = 0; done < order.size(); ++done) {
        if (!placed[order[done]]) bins.push_back(fill_bin(blocks, std::span(order).subspan(done), placed));
        bin_of[order[done]] = bins.size() - 1;
    }
    const PackedSize size = pack_all(bins);
    for (std::size_t i = 0; i < blocks.size(); ++i) blocks[i].x += bins[bin_of[i]].x, blocks[i].y += bins[bin_of[i]].y;
    return size;
}

}  // namespace

PackedSize pack(std::vector<Block>& blocks) {
    double sum = 0.0;
    for (const Block& b : blocks) {
        if (std::max(b.width, b.height) > kMaxAtlasSide) refuse_atlas_size();
        sum += area(b);
    }
    return sum <= kFewTexels || blocks.size() == 1 ? pack_all(blocks) : pack_by_place(blocks);
}

void refuse_atlas_size() {
    throw Error("lightmap",
                "the static surfaces need more than 16384 x 16384 texels; bake with a coarser "
                "--quality or split the scene");
}

}  // namespace daylit

// Where charts lie in the atlas: apart, in little room, and beside what is near them in the world.
#include "gi/surface/pack.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <string>
#include <utility>

#include "engine/baked/day_lightmap.h"
#include "engine/base/error.h"
#include "engine/base/random.h"

namespace daylit {
namespace {

constexpr int kRooms = 2;

int between(Random& random, int least, int most) {
    return std::min(least + int(random.next() * float(most - least + 1)), most);
}

Vec3 somewhere(Random& random, float size) {
    return size * Vec3(random.next(), random.next(), random.next());
}

/// Every width from 2 to 200 with every height from 2 to 90, once.
std::vector<Block> every_size() {
    Random random(1, 0, 0);
    std::vector<Block> blocks;
    for (int width = 2; width <= 200; ++width)
        for (int height = 2; height <= 90; ++height) blocks.push_back({width, height, somewhere(random, 100.0f)});
    return blocks;
}

/// As of a furnished room: most charts are small, a few are walls.
std::vector<Block> furniture() {
    Random random(2, 0, 0);
    std::vector<Block> blocks;
    for (int i = 0; i < 6000; ++i) {
        const int most = i % 50 == 0 ? 90 : 12;
        blocks.push_back({between(random, 2, most), between(random, 2, most), somewhere(random, 10.0f)});
    }
    return blocks;
}

std::vector<Block> dust() {
    return std::vector<Block>(9000, Block{});
}

/// As of rails and skirting boards, half of them upright.
std::vector<Block> strips() {
    Random random(3, 0, 0);
    std::vector<Block> blocks;
    for (int i = 0; i < 2000; ++i) {
        const int length = between(random, 100, 700), thickness = between(random, 2, 4);
        blocks.push_back({i % 2 ? length : thickness, i % 2 ? thickness : length, somewhere(random, 50.0f)});
    }
    return blocks;
}

double texels_of(const std::vector<Block>& blocks) {
    return std::accumulate(blocks.begin(), blocks.end(), 0.0,
                           [](double sum, const Block& b) { return sum + double(b.width) * double(b.height); });
}

/// Which block each texel of the atlas belongs to, -1: none; fails where two want one, or one lies outside.
std::vector<int> owners(const std::vector<Block>& blocks, const PackedSize& size) {
    std::vector<int> owner(std::size_t(size.width) * std::size_t(size.height), -1);
    for (std::size_t i = 0; i < blocks.size(); ++i) {
        const Block& b = blocks[i];
        const bool inside = b.x >= 0 && b.y >= 0 && b.x + b.width <= size.width && b.y + b.height <= size.height;
        EXPECT_TRUE(inside) << "block " << i;
        if (!inside) continue;
        for (int y = b.y; y < b.y + b.height; ++y) {
            const auto row = owner.begin() + std::ptrdiff_t(y) * size.width;
            EXPECT_TRUE(std::all_of(row + b.x, row + b.x + b.width, [](int o) { return o < 0; })) << "block " << i;
            std::fill_n(row + b.x, b.width, int(i));
        }
    }
    return owner;
}

struct Case {
    std::string name;
    std::vector<Block> (*blocks)();
    double most;  // of the atlas's texels, per texel of a block
};

class Pack : public testing::TestWithParam<Case> {};

TEST_P(Pack, BlocksLieApartInTheAtlas) {
    std::vector<Block> blocks = GetParam().blocks();
    const PackedSize size = pack(blocks);
    owners(blocks, size);
    EXPECT_LE(std::max(size.width, size.height), kMaxAtlasSide);
}

TEST_P(Pack, LittleOfTheAtlasIsWasted) {
    std::vector<Block> blocks = GetParam().blocks();
    const PackedSize size = pack(blocks);
    EXPECT_LT(double(size.width) * double(size.height), GetParam().most * texels_of(blocks));
}

TEST_P(Pack, TheSameBlocksLieAtTheSamePlaces) {
    std::vector<Block> blocks = GetParam().blocks(), again = blocks;
    const PackedSize size = pack(blocks), other = pack(again);
    EXPECT_EQ(std::pair(size.width, size.height), std::pair(other.width, other.height));
    for (std::size_t i = 0; i < blocks.size(); ++i)
        ASSERT_EQ(std::pair(blocks[i].x, blocks[i].y), std::pair(again[i].x, again[i].y)) << i;
}

INSTANTIATE_TEST_SUITE_P(Blocks, Pack,
                         testing::Values(Case{"EverySize", every_size, 1.25}, Case{"Furniture", furniture, 1.18},
                                         Case{"Dust", dust, 1.06}, Case{"Strips", strips, 1.6}),
                         [](const auto& info) { return info.param.name; });

/// Blocks of rooms in turn, `apart` metres from one another.
std::vector<Block> rooms_in_turn(float apart) {
    Random random(4, 0, 0);
    std::vector<Block> blocks;
    for (int i = 0; i < 4000; ++i) {
        const int most = i / kRooms % 40 == 0 ? 60 : 14;
        const Vec3 place = somewhere(random, 8.0f) + Vec3(apart * float(i % kRooms), 0, 0);
        blocks.push_back({between(random, 2, most), between(random, 2, most), place});
    }
    return blocks;
}

/// Of the tiles that hold something, those with texels of both rooms.
double share_of_mixed_tiles(std::vector<Block> blocks) {
    constexpr int kTile = DayLightmap::kTileSide;
    const PackedSize size = pack(blocks);
    const std::vector<int> owner = owners(blocks, size);
    const int across = (size.width + kTile - 1) / kTile, down = (size.height + kTile - 1) / kTile;
    std::vector<unsigned> rooms(std::size_t(across) * std::size_t(down));  // bits
    for (int y = 0; y < size.height; ++y)
        for (int x = 0; x < size.width; ++x)
            if (const int o = owner[std::size_t(y) * std::size_t(size.width) + std::size_t(x)]; o >= 0)
                rooms[std::size_t(y / kTile * across + x / kTile)] |= 1u << o % kRooms;
    const auto filled = rooms.size() - std::size_t(std::count(rooms.begin(), rooms.end(), 0u));
    return double(std::count(rooms.begin(), rooms.end(), 3u)) / double(filled);
}

TEST(PackRooms, TilesBelongToOneRoom) {
    EXPECT_LT(share_of_mixed_tiles(rooms_in_turn(200.0f)), 0.03);
    // A packing that does not know where blocks are mixes the rooms in every tile of small blocks.
    EXPECT_GT(share_of_mixed_tiles(rooms_in_turn(0.0f)), 0.5);
}

TEST(PackFew, ABlockAloneFillsTheAtlas) {
    for (const auto& [width, height] : {std::pair(2, 2), std::pair(37, 5), std::pair(3, 900), std::pair(700, 300)}) {
        std::vector<Block> blocks{{width, height, Vec3(1, 2, 3)}};
        const PackedSize size = pack(blocks);
        EXPECT_EQ(std::pair(size.width, size.height), std::pair(width, height));
        EXPECT_EQ(std::pair(blocks[0].x, blocks[0].y), std::pair(0, 0));
    }
}

TEST(PackFew, BlocksAsLongAsTheLargestAtlasFit) {
    std::vector<Block> blocks{{kMaxAtlasSide, 2, Vec3(0)}, {kMaxAtlasSide, 9, Vec3(1)}, {2, 16000, Vec3(2)}};
    const PackedSize size = pack(blocks);
    owners(blocks, size);
    EXPECT_LE(std::max(size.width, size.height), kMaxAtlasSide);
}

std::string refusal(std::vector<Block> blocks) {
    try {
        pack(blocks);
    } catch (const Error& error) {
        return error.what();
    }
    return "";
}

TEST(PackFew, WhatDoesNotFitIsRefusedByName) {
    constexpr int kLong = kMaxAtlasSide + 1;
    for (const auto& blocks :
         {std::vector<Block>{{kLong, 2}}, std::vector<Block>{{2, 2}, {2, kLong}, {9, 9}},
          std::vector<Block>{{kMaxAtlasSide, kMaxAtlasSide}, {2, 2}}, std::vector<Block>(70, Block{2048, 2048})})
        EXPECT_EQ(refusal(blocks).rfind("lightmap: ", 0), 0u) << refusal(blocks);
}

}  // namespace
}  // namespace daylit

// Damaged .daylit files: every byte is under a check sum, so none of them is ever shown as light.
#include <gtest/gtest.h>

#include <map>

#include "engine/baked/baked_file.h"
#include "engine/base/error.h"
#include "engine/base/file.h"
#include "engine/base/random.h"
#include "tests/support/gltf_builder.h"

namespace daylit {
namespace {

namespace fs = std::filesystem;

/// Empty when the file was taken.
std::string refusal(const fs::path& path) {
    try {
        read_baked(path);
        return {};
    } catch (const Error& error) {
        EXPECT_NE(std::string(error.what()).find(path.filename().string()), std::string::npos) << error.what();
        for (const unsigned char c : std::string(error.what())) EXPECT_GE(c, ' ') << error.what();
        return error.what();
    }
}

class FrozenFiles : public testing::Test {
  protected:
    void SetUp() override {
        for (const auto& entry : fs::directory_iterator(DAYLIT_TESTS_DIR "/frozen"))
            if (entry.path().extension() == ".daylit")
                files_[entry.path().filename().string()] = read_file(entry.path());
        ASSERT_FALSE(files_.empty());
    }
    std::string refusal_of(const std::vector<std::uint8_t>& bytes) {
        write_file(folder_ / "damaged.daylit", bytes);
        return refusal(folder_ / "damaged.daylit");
    }
    std::map<std::string, std::vector<std::uint8_t>> files_;
    test::TemporaryFolder folder_;
};

TEST_F(FrozenFiles, AThousandFlippedBits) {
    for (const auto& [name, bytes] : files_)
        for (std::uint64_t i = 0; i < 1000; ++i) {
            std::vector<std::uint8_t> flipped = bytes;
            const std::uint64_t bit = Random(1, i, 0).bits() % (8 * bytes.size());
            flipped[bit / 8] ^= std::uint8_t(1u << bit % 8);
            EXPECT_NE(refusal_of(flipped), "") << name << ", bit " << bit;
        }
}

TEST_F(FrozenFiles, CutAnywhereOrTooLong) {
    for (const auto& [name, bytes] : files_) {
        const std::size_t step = std::max<std::size_t>(1, bytes.size() / 1000);
        for (std::size_t length = 0; length < bytes.size(); length += step)
            EXPECT_NE(refusal_of({bytes.begin(), bytes.begin() + std::ptrdiff_t(length)}), "")
                << name << ", " << length;
        std::vector<std::uint8_t> longer = bytes;
        longer.push_back(0);
        EXPECT_NE(refusal_of(longer), "") << name;
    }
}

TEST_F(FrozenFiles, RunsOfBytesOverwritten) {
    for (const auto& [name, bytes] : files_)
        for (std::uint64_t i = 0; i < 200; ++i) {
            std::vector<std::uint8_t> damaged = bytes;
            Random random(2, i, 0);
            const std::size_t first = random.bits() % bytes.size();
            const std::size_t last = std::min<std::size_t>(bytes.size(), first + 1 + random.bits() % 64);
            for (std::size_t k = first; k < last; ++k) damaged[k] = std::uint8_t(random.bits());
            if (damaged == bytes) continue;
            EXPECT_NE(refusal_of(damaged), "") << name << ", " << first << " to " << last;
        }
}

}  // namespace
}  // namespace daylit

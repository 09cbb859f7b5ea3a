#include "engine/base/file.h"

#include <gtest/gtest.h>

#include "engine/base/error.h"
#include "tests/support/gltf_builder.h"

namespace daylit {
namespace {

std::string text_of(const std::filesystem::path& path) {
    const std::vector<std::uint8_t> bytes = read_file(path);
    return {bytes.begin(), bytes.end()};
}

std::size_t files_in(const std::filesystem::path& folder) {
    std::size_t count = 0;
    for ([[maybe_unused]] const auto& entry : std::filesystem::directory_iterator(folder)) ++count;
    return count;
}

TEST(File, what_is_written_is_read) {
    const test::TemporaryFolder folder;
    write_file(folder / "a.txt", std::string("first"));
    write_file(folder / "a.txt", std::string("second"));
    EXPECT_EQ(text_of(folder / "a.txt"), "second");
    EXPECT_EQ(files_in(folder.path()), 1u);
}

TEST(File, a_failed_write_leaves_the_old_file_and_nothing_else) {
    const test::TemporaryFolder folder;
    write_file(folder / "a.txt", std::string("old"));
    const auto failing = [](const std::filesystem::path& temporary) {
        EXPECT_EQ(temporary.extension(), ".txt");
        write_file(temporary, std::string("half"));
        throw Error("disk", "is full");
    };
    EXPECT_THROW(write_whole(folder / "a.txt", failing), Error);
    EXPECT_EQ(text_of(folder / "a.txt"), "old");
    EXPECT_EQ(files_in(folder.path()), 1u);
}

TEST(File, places_that_cannot_be_written_or_read) {
    const test::TemporaryFolder folder;
    EXPECT_THROW(write_file(folder / "absent" / "a.txt", std::string("x")), Error);
    EXPECT_THROW(write_file(folder.path(), std::string("x")), Error);
    EXPECT_THROW(write_file("", std::string("x")), Error);
    EXPECT_THROW(read_file(folder / "absent.txt"), Error);
    EXPECT_THROW(read_file(folder.path()), Error);
}

TEST(File, the_limit_holds) {
    const test::TemporaryFolder folder;
    write_file(folder / "a.txt", std::string("12345"));
    EXPECT_EQ(read_file(folder / "a.txt", 5).size(), 5u);
    EXPECT_THROW(read_file(folder / "a.txt", 4), Error);
}

}  // namespace
}  // namespace daylit

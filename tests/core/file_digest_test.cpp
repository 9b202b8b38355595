#include <fstream>

#include <gtest/gtest.h>

#include "solidnoise/core/digest.h"
#include "support/temporary_folder.h"

namespace solidnoise::file_digest_test {
namespace {

// The values that the authors of FNV publish for these texts.
TEST(FileDigest, IsFnv1a) {
  EXPECT_EQ(digest(""), "cbf29ce484222325");
  EXPECT_EQ(digest("a"), "af63dc4c8601ec8c");
  EXPECT_EQ(digest("foobar"), "85944171f73967e8");
}

TEST(FileDigest, IsThatOfAllBytes) {
  const TemporaryFolder folder;
  const std::string bytes((std::size_t{5} << 18) + 1, '\xff');  // more than is read at once
  std::ofstream(folder / "x", std::ios::binary) << bytes;
  EXPECT_EQ(file_digest(folder / "x"), digest(bytes));
}

TEST(FileDigest, IsNoneOfWhatIsNoFile) {
  const TemporaryFolder folder;
  EXPECT_EQ(file_digest(folder / "no such file"), "");
}

}  // namespace
}  // namespace solidnoise::file_digest_test

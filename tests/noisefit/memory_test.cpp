#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "noisefit/expect_fit_memory.h"

namespace solidnoise::memory_test {
namespace {

// In colour, of 64 to 1024 pixels along a side.
const TemporaryFolder& pictures() {
  static const TemporaryFolder folder;
  if (folder.count() == 0) {
    for (const int side : {64, 256, 512, 1024}) {
      write_image(folder.path() / (std::to_string(side) + ".png"), wavy_picture(side, side));
    }
    write_image(folder.path() / "wide.png", wavy_picture(1024, 96));
  }
  return folder;
}

class FitMemory : public testing::TestWithParam<std::vector<std::string>> {};

TEST_P(FitMemory, IsWhatAFitTakes) {
  expect_fit_memory(GetParam(), {.folder = pictures().path()});
}

INSTANTIATE_TEST_SUITE_P(
    Noisefit, FitMemory,
    testing::Values(std::vector<std::string>{"64.png"},                                    //
                    std::vector<std::string>{"64.png", "--preview", "x.png"},              //
                    std::vector<std::string>{"256.png", "--grey"},                         //
                    std::vector<std::string>{"512.png", "--quiet"},                        //
                    std::vector<std::string>{"512.png", "--grey"},                         //
                    std::vector<std::string>{"512.png", "--preview", "x.png"},             //
                    std::vector<std::string>{"512.png", "--solid", "--preview", "x.png"},  //
                    std::vector<std::string>{"512.png", "512.png", "512.png", "512.png", "--quiet"},
                    std::vector<std::string>{"64.png", "1024.png", "--quiet"},
                    std::vector<std::string>{"1024.png", "--grey", "--quiet"},
                    std::vector<std::string>{"1024.png", "--patch", "64", "--quiet"},
                    std::vector<std::string>{"1024.png", "--patch", "64"},
                    std::vector<std::string>{"1024.png", "--patch", "64", "--grey"},
                    std::vector<std::string>{"1024.png", "--patch", "128", "--preview", "x.png"},
                    std::vector<std::string>{"wide.png", "--grey", "--preview", "x.png"}));

TEST(FitMemory, OfAPictureIsNotTakenWhereItIsRefused) {
#ifdef __SANITIZE_ADDRESS__
  GTEST_SKIP() << "the sanitizer takes memory of its own";
#endif
  const TemporaryFolder folder;
  write_image(folder / "large.png", Image(6144, 6144, 3));
  const ToolResult refused =
      run_noisefit({"large.png", "--max-memory", "200M", "--out", "x.json"}, {.folder = folder.path()});
  EXPECT_EQ(refused.status, 1);
  EXPECT_NE(refused.err.find("cannot read large.png: reading it may need "), std::string::npos)
      << refused.err;
  EXPECT_NE(refused.err.find("--max-memory allows 200.0 MiB"), std::string::npos) << refused.err;
  EXPECT_LT(refused.peak_memory, 200.0 * 0x1p20);
}

TEST(FitMemory, IsWhatAnEditTakes) {
  const RunOptions there{.folder = pictures().path()};
  ASSERT_EQ(run_noisefit({"64.png", "--kappa", "0.25", "--out", "model.json", "--force"}, there).status, 0);
  const auto run = [&](const std::vector<std::string>& arguments) { return run_noisefit(arguments, there); };
  expect_limits(run, {"edit", "model.json", "--scale", "2", "--out", "x.json", "--force"});
  expect_limits(run, {"edit", "model.json", "--scale", "2", "--preview", "x.png", "--force"});
}

}  // namespace
}  // namespace solidnoise::memory_test

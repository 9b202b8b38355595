#include "solidnoise/volume/sky/points_file.h"

#include <stdexcept>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "support/message_of.h"
#include "support/temporary_folder.h"

namespace solidnoise::points_file_test {
namespace {

std::vector<SkyPoint> read(const std::string& text, const std::string& name = "p.csv") {
  const TemporaryFolder folder;
  folder.write(name, text);
  return read_points(folder / name, {.size = 700.0});
}

// Without the folder, which stands before the file's name.
std::string refusal(const std::string& text, const std::string& name = "p.csv") {
  const std::string message = message_of<std::runtime_error>([&] { read(text, name); });
  return message.substr(message.find(name));
}

TEST(PointsFile, ReadsColumnsInAnyOrder) {
  const std::vector<SkyPoint> points =
      read("# a sky\n z, x ,y,seed,turn\n\n3,1e3,-2,18446744073709551615,-90 # the first\r\n0.5,0,0,7,0\n");
  ASSERT_EQ(points.size(), 2u);
  EXPECT_EQ(points[0], (SkyPoint{1000.0, -2.0, 3.0, 700.0, -90.0, 18446744073709551615u}));
  EXPECT_EQ(points[1], (SkyPoint{0.0, 0.0, 0.5, 700.0, 0.0, 7}));
}

TEST(PointsFile, PassesOverTheMarkThatSpreadsheetsWriteFirst) {
  EXPECT_EQ(read("\xef\xbb\xbfx,y,z\n1,2,3\n"), (std::vector<SkyPoint>{{1, 2, 3, 700}}));
}

TEST(PointsFile, ReadsBackWhatWasWritten) {
  const std::vector<SkyPoint> points{{0.1, -2e7, 1.0 / 3.0, 123.456, 359.9, 9}, {1, 2, 3, 4, 5, 6}};
  EXPECT_EQ(read(points_text(points)), points);
  EXPECT_EQ(read(points_text(points, {{"a.vdb", 1.1}, {"b.vdb", 0.9}})), points);
}

TEST(PointsFile, ReadsVerticesOfAPly) {
  const std::vector<SkyPoint> points = read(
      "ply\nformat ascii 1.0\nelement vertex 2\nproperty float x\nproperty float y\nproperty float "
      "z\nproperty "
      "float nx\nproperty float size\nproperty uint seed\nend_header\n1 2 3 0 50 8\n4 5 6 0 60 9\n",
      "p.ply");
  EXPECT_EQ(points, (std::vector<SkyPoint>{{1, 2, 3, 50, 0, 8}, {4, 5, 6, 60, 0, 9}}));
}

TEST(PointsFile, SaysLineAndColumnOfWhatIsWrong) {
  EXPECT_EQ(refusal("x,y,z\n1,2,3\n1,nan,3\n"),
            "p.csv:3: column 2: y is nan; it must be between -100000000 and "
            "100000000 (world units)");
  EXPECT_EQ(refusal("x,y,z\n1,2,1e9\n"),
            "p.csv:2: column 3: z is 1000000000; it must be between -100000000 and 100000000 (world units)");
  EXPECT_EQ(refusal("x,y,z\n1,2,3m\n"), "p.csv:2: column 3: z is '3m'; it must be a number");
  EXPECT_EQ(refusal("x,y,z,size\n1,2,3,0\n"),
            "p.csv:2: column 4: size is 0; it must be between 0.001 and 100000000 (world units)");
  EXPECT_EQ(refusal("x,y,z,seed\n1,2,3,-1\n"),
            "p.csv:2: column 4: seed is '-1'; it must be a whole number, 0 to 18446744073709551615");
  EXPECT_EQ(refusal("x,y,z\n1,2,3\n1,2\n"), "p.csv:3: there are 2 columns here; the first line names 3");
  EXPECT_EQ(refusal("x,y,z,sise\n1,2,3,4\n"),
            "p.csv:1: there is no column 'sise'; columns are x, y, z, size, turn, seed, file and scale");
  EXPECT_EQ(refusal("x,y,x\n"), "p.csv:1: column x is there twice");
  EXPECT_EQ(refusal("x,z\n1,2\n"), "p.csv:1: column y is missing; the first line names the columns");
  EXPECT_EQ(refusal("x,y,z\n"), "p.csv: has no points");
  EXPECT_EQ(refusal(""), "p.csv: has no points");
  EXPECT_EQ(refusal("x", "p.txt"), "p.txt: points are read from .csv and .ply");
  EXPECT_EQ(
      refusal("ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty float "
              "z\nproperty float size\nend_header\n1 2 3 nan\n",
              "p.ply"),
      "p.ply: vertex 0: size is nan; it must be between 0.001 and 100000000 (world units)");
}

TEST(PointsFile, RefusesMorePointsThanASkyMayHave) {
  std::string text = "x,y,z\n";
  for (std::size_t i = 0; i <= kMostSkyPoints; ++i) text += "1,2,3\n";
  EXPECT_EQ(refusal(text), "p.csv: has more than 100000 points; a sky has at most 100000");
}

}  // namespace
}  // namespace solidnoise::points_file_test

#include <cmath>
#include <cstddef>
#include <fstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "meshnoise/run_meshnoise.h"
#include "solidnoise/image/image_file.h"
#include "tools/run_tool.h"

namespace solidnoise::textures_test {
namespace {

// Two squares side by side, of which the second is in another tile.
constexpr char kTwoTiles[] =
    "v 0 0 0\nv 1 0 0\nv 2 0 0\nv 0 1 0\nv 1 1 0\nv 2 1 0\n"
    "vt 0.1 0.1\nvt 0.9 0.1\nvt 0.9 0.9\nvt 0.1 0.9\nvt 1.1 1.1\nvt 1.9 1.1\nvt 1.9 1.9\nvt 1.1 1.9\n"
    "f 1/1 2/2 5/3 4/4\nf 2/5 3/6 6/7 5/8\n";

class Textures : public testing::Test {
 protected:
  void write(const std::string& name, const std::string& text) {
    std::ofstream(folder_.file(name), std::ios::binary) << text;
  }

  ToolResult bake(std::vector<std::string> flags, const std::string& in = "in.obj") {
    flags.insert(flags.begin(), {"bake", in});
    return run_meshnoise(flags, {.folder = folder_.path()});
  }

  // What is said of wrong input, in one line; nothing may be left of it.
  std::string refusal(const std::vector<std::string>& flags, const std::string& in = "in.obj") {
    const auto before = folder_.names();
    const ToolResult result = bake(flags, in);
    EXPECT_NE(result.status, 0);
    EXPECT_EQ(folder_.names(), before);
    return result.err;
  }

  static bool has(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
  }

  TemporaryFolder folder_;
};

TEST_F(Textures, AreFilesOfTilesAndMaps) {
  write("in.obj", kTwoTiles);
  const ToolResult result =
      bake({"--uv", "x_<MAP>.<UDIM>.exr", "--map", "color,normal,roughness,noise", "--uv-size", "32"});
  ASSERT_EQ(result.status, 0) << result.err;
  std::set<std::string> expected{"in.obj"};
  for (const std::string map : {"color", "normal", "roughness", "noise"}) {
    for (const std::string tile : {"1001", "1012"}) expected.insert("x_" + map + "." + tile + ".exr");
  }
  EXPECT_EQ(folder_.names(), expected);
  const Image color = read_image(folder_.file("x_color.1012.exr"));
  EXPECT_EQ(color.width, 32);
  EXPECT_EQ(color.channels, 3);
  EXPECT_EQ(read_image(folder_.file("x_noise.1001.exr")).channels, 1);
  EXPECT_TRUE(has(bake({"--uv", "x_<MAP>.<UDIM>.exr", "--map", "color,noise"}).err, "exists; --force"));
}

TEST_F(Textures, HoldNumbersAroundAHalfInWholeNumbers) {
  write("in.obj", kTwoTiles);
  const std::vector<std::string> flags{"--noise", "surface", "--map", "noise", "--uv-size", "64"};
  for (const std::string name : {"a.<UDIM>.png", "a.<UDIM>.tif", "a.<UDIM>.exr"}) {
    std::vector<std::string> all = flags;
    all.insert(all.end(), {"--uv", name});
    const ToolResult result = bake(all);
    ASSERT_EQ(result.status, 0) << result.err;
    EXPECT_EQ(has(result.err, "0.5 + value / 8"), name != "a.<UDIM>.exr") << result.err;
  }
  const Image exact = read_image(folder_.file("a.1001.exr"));
  for (const std::string name : {"a.1001.png", "a.1001.tif"}) {
    const Image whole = read_image(folder_.file(name));
    for (int y = 10; y < 50; ++y) {
      for (int x = 10; x < 50; ++x) EXPECT_NEAR(whole.at(x, y), 0.5 + exact.at(x, y) / 8.0, 0.6 / 65535.0);
    }
  }
}

TEST_F(Textures, AreDescribedBeforeWork) {
  write("in.obj", kTwoTiles);
  const ToolResult result = bake({"--uv", "x.<UDIM>.png", "--describe", "--uv-size", "512"});
  ASSERT_EQ(result.status, 0) << result.err;
  const auto textures = nlohmann::json::parse(result.out).at("textures");
  EXPECT_EQ(textures.at("files"), nlohmann::json({"x.1001.png", "x.1012.png"}));
  EXPECT_NEAR(textures.at("texels").get<double>(), 2 * 0.64 * 512 * 512, 1.0);
  EXPECT_TRUE(has(refusal({"--uv", "x.<UDIM>.png", "--uv-size", "16384", "--max-memory", "1G"}),
                  "--max-memory allows 1.0 GiB; make --uv-size smaller"));
}

TEST_F(Textures, RefuseWhatCannotBe) {
  write("in.obj", kTwoTiles);
  write("bare.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  write("part.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nf 1/1 2/2 3/3\nf 1/1 2/9 3/3\n");
  write("flat.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nf 1/1 2/2 3/2\n");
  write("far.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 10 0\nvt 11 0\nvt 10 1\nf 1/1 2/2 3/3\n");
  EXPECT_TRUE(has(refusal({"--uv", "x.<UDIM>.png"}, "bare.obj"), "bare.obj: it has no texture coordinates"));
  EXPECT_TRUE(
      has(refusal({"--uv", "x.<UDIM>.png"}, "part.obj"), "part.obj: face 1 lacks texture coordinates"));
  EXPECT_TRUE(has(refusal({"--uv", "x.<UDIM>.png"}, "flat.obj"), "none of the faces has an area"));
  EXPECT_TRUE(has(refusal({"--uv", "x.<UDIM>.png"}, "far.obj"), "they must be from 0 to 10"));
  EXPECT_TRUE(has(refusal({"--uv", "x.png"}), "or the textures' name have <UDIM> in it"));
  EXPECT_TRUE(has(refusal({"--uv", "x.<UDIM>.jpg"}), "it must end in .png or .tif or .tiff or .exr"));
  EXPECT_TRUE(has(refusal({"--uv", "x.<UDIM>.png", "--map", "color,normal"}), "it must have <MAP> in it"));
  EXPECT_TRUE(has(refusal({"--uv", "x.<UDIM>.png", "--map", "gloss"}), "--map is gloss"));
  EXPECT_TRUE(has(refusal({"--uv", "<MAP>.<UDIM>.png", "--map", "color,color"}), "names color twice"));
  EXPECT_TRUE(has(refusal({"--uv", "x.<UDIM>.png", "--uv-size", "0"}), "--uv-size is 0"));
  EXPECT_TRUE(has(refusal({"--out", "x.ply", "--uv-size", "64"}), "--uv-size"));
  EXPECT_TRUE(has(refusal({"--uv", "x.<UDIM>.png", "--preview", "x.1012.png", "--force"}), "x.1012.png"));
  EXPECT_TRUE(has(bake({"--uv", "y.<UDIM>.png", "--uv-size", "32"}, "in.obj").err, "y.1012.png"));
}

TEST_F(Textures, GoWithAMesh) {
  write("in.obj", kTwoTiles);
  const ToolResult result = bake({"--out", "out.ply", "--uv", "x.<UDIM>.png", "--uv-size", "16", "--quiet"});
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_EQ(folder_.names(), (std::set<std::string>{"in.obj", "out.ply", "x.1001.png", "x.1012.png"}));
}

}  // namespace
}  // namespace solidnoise::textures_test

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "meshnoise/run_meshnoise.h"
#include "meshnoise/sample_torus.h"

namespace solidnoise::bake_test {
namespace {

const std::vector<std::string> kFormats{"ply", "obj", "off", "om"};

// Bakes `in` of the folder into `out`, quietly, and reads it back.
PolygonMesh bake(const TemporaryFolder& folder, const std::string& in, const std::string& out,
                 const std::vector<std::string>& flags = {}) {
  std::vector<std::string> arguments{"bake", in, "--out", out, "--quiet"};
  arguments.insert(arguments.end(), flags.begin(), flags.end());
  const ToolResult result = run_meshnoise(arguments, {.folder = folder.path()});
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_EQ(result.err, "");
  EXPECT_EQ(result.out, "");
  return read_mesh(folder.file(out)).mesh;
}

// Colours in 8 bits, whatever the file has.
std::vector<int> colors_of(const PolygonMesh& mesh) {
  std::vector<int> colors;
  for (std::size_t channel = 0; channel < 3; ++channel) {
    const VertexProperty* const property = mesh.property(kColorNames[channel]);
    if (!property) return {};
    const double scale = property->type == ScalarType::uint8 ? 1.0 : 255.0;
    for (const double value : property->values)
      colors.push_back(static_cast<int>(std::lround(scale * value)));
  }
  return colors;
}

TEST(Bake, NeedsNoFlagButTheOutput) {
  const TemporaryFolder folder;
  write_sample(folder, "in.ply", sample_torus());
  const ToolResult result = run_meshnoise({"bake", "in.ply", "--out", "out.ply"}, {.folder = folder.path()});
  ASSERT_EQ(result.status, 0) << result.err;
  for (const char* word : {"out.ply", "vertices", "faces", "min", "max", "mean", "sigma", "####"}) {
    EXPECT_NE(result.err.find(word), std::string::npos) << result.err;
  }
  EXPECT_EQ(folder.names(), (std::set<std::string>{"in.ply", "out.ply"}));
  const PolygonMesh baked = read_mesh(folder.file("out.ply")).mesh;
  EXPECT_GT(spread(numbers_of(baked, "noise")), 1.0);
  EXPECT_GT(spread(numbers_of(baked, "red")), 20.0);
}

TEST(Bake, WritesEveryFormatWithTheSameMeshAndColors) {
  const TemporaryFolder folder;
  const PolygonMesh torus = sample_torus();
  write_sample(folder, "in.ply", torus);
  const std::vector<int> colors = colors_of(bake(folder, "in.ply", "reference.ply"));
  ASSERT_EQ(colors.size(), 3 * torus.positions.size());
  for (const std::string& format : kFormats) {
    const PolygonMesh baked = bake(folder, "in.ply", "out." + format);
    ASSERT_EQ(baked.positions.size(), torus.positions.size()) << format;
    for (std::size_t v = 0; v < torus.positions.size(); ++v) {
      // The decimals of a text are those of a float.
      EXPECT_EQ(glm::vec3(baked.positions[v]), glm::vec3(torus.positions[v])) << format << ' ' << v;
    }
    EXPECT_EQ(baked.corners, torus.corners) << format;
    EXPECT_EQ(baked.face_starts, torus.face_starts) << format;
    EXPECT_EQ(colors_of(baked), colors) << format;
  }
}

TEST(Bake, ReadsEveryFormatAsTheSameSurface) {
  const TemporaryFolder folder;
  const PolygonMesh torus = sample_torus(14, 0x1p-7);
  write_sample(folder, "in.ply", torus);
  const std::vector<double> noise = numbers_of(bake(folder, "in.ply", "reference.ply"), "noise");
  ASSERT_GT(spread(noise), 1.0);
  for (const std::string& format : kFormats) {
    if (format != "ply") write_sample(folder, "in." + format, torus);
    const std::vector<double> same = numbers_of(bake(folder, "in." + format, format + ".ply"), "noise");
    EXPECT_EQ(same, noise) << format;
  }
}

TEST(Bake, MergesTheVerticesThatFacetsOfAnStlShare) {
  const TemporaryFolder folder;
  std::string text = "solid tetrahedron\n";
  for (const std::string facet :
       {"0 0 0,0 1 0,1 0 0", "0 0 0,1 0 0,0 0 1", "0 0 0,0 0 1,0 1 0", "1 0 0,0 1 0,0 0 1"}) {
    text += "facet normal 0 0 0\nouter loop\n";
    for (std::size_t i = 0; i < facet.size(); i += 6) text += "vertex " + facet.substr(i, 5) + "\n";
    text += "endloop\nendfacet\n";
  }
  folder.write("in.stl", text + "endsolid tetrahedron\n");
  const PolygonMesh baked = bake(folder, "in.stl", "out.ply");
  EXPECT_EQ(baked.positions, (std::vector<Vec<3>>{{0, 0, 0}, {0, 1, 0}, {1, 0, 0}, {0, 0, 1}}));
  EXPECT_EQ(baked.face_count(), 4u);
}

// A sphere's meridian and poles that are there more than once, apart by the rounding of single precision.
TEST(Bake, HasOneValueAtEachPlaceOfASeam) {
  const TemporaryFolder folder;
  const PolygonMesh sphere = seamed_sphere_mesh(1.0, 12);
  write_sample(folder, "in.ply", sphere);
  const std::vector<Vec<3>> places = with_closed_seams(sphere).positions;
  const std::vector<std::vector<std::string>> looks{
      {"--noise", "surface"}, {"--noise", "oriented"}, {"--noise", "kensler"}, {"--preset", "rust"}};
  for (const std::vector<std::string>& look : looks) {
    const std::string out = look.back() + ".ply";
    const std::vector<double> values = numbers_of(bake(folder, "in.ply", out, look), "noise");
    ASSERT_EQ(values.size(), places.size());
    for (std::size_t v = 0; v < places.size(); ++v) {
      const auto first = std::find(places.begin(), places.end(), places[v]) - places.begin();
      // Some 7 cycles, each of a slope of 2 pi standard deviations, times 2e-7: a hundredfold of that.
      EXPECT_NEAR(values[v], values[static_cast<std::size_t>(first)], 1e-3) << out << ' ' << v;
    }
  }
}

TEST(Bake, KeepsWhatTheVerticesHad) {
  const TemporaryFolder folder;
  PolygonMesh torus = torus_with_numbers();
  torus.properties.insert(torus.properties.begin(),
                          {"green", ScalarType::uint8, std::vector<double>(torus.positions.size(), 77.0)});
  torus.position_type = ScalarType::float64;
  torus.positions[5].x += 1e-12;
  write_sample(folder, "in.ply", torus, {"scanned on a Tuesday"});
  const PolygonMesh baked = bake(folder, "in.ply", "out.ply", {"--preset", "raw"});
  EXPECT_EQ(baked.positions, torus.positions);
  EXPECT_EQ(baked.position_type, ScalarType::float64);
  EXPECT_EQ(property_names(baked),
            (std::vector<std::string>{"green", "heat", "label", "red", "blue", "alpha", "noise"}));
  EXPECT_EQ(baked.property("label")->type, ScalarType::int16);
  EXPECT_EQ(baked.property("noise")->type, ScalarType::float32);
  EXPECT_EQ(baked.property("red")->type, ScalarType::uint8);
  for (const std::string name : {"heat", "label"})
    EXPECT_EQ(numbers_of(baked, name), numbers_of(torus, name));
  const std::vector<std::string> comments = read_mesh(folder.file("out.ply")).comments;
  EXPECT_EQ(comments.front(), "scanned on a Tuesday");
  bake(folder, "out.ply", "again.ply", {"--preset", "raw"});
  EXPECT_EQ(read_mesh(folder.file("again.ply")).comments, comments) << "comments pile up";
}

TEST(Bake, RecipeOfAMeshMakesTheSameBytesAgain) {
  const std::vector<std::vector<std::string>> cases{
      {},
      {"--preset", "scales", "--seed", "18446744073709551615", "--size", "0.5..0.2", "--by", "height"},
      {"--noise", "oriented", "--follow", "max-curvature", "--octaves", "2", "--detail", "0.5..2", "--gamma",
       "0.5"},
      {"--noise", "kensler", "--frequency", "3.3", "--ramp", "0:#123,0.3:#fed,1:#abcdef", "--contrast",
       "1.3"},
      {"--noise", "kensler-solid", "--detail", "1", "--displace", "0.02", "--refine", "1", "--up", "z"},
      {"--frequency", "1..3", "--octaves", "1", "--bandwidth", "0.5..2", "--magnitude", "0.5..1.5", "--by",
       "heat", "--percentiles", "10", "80", "--error", "0.1", "--layer", "0.7", "--refine", "auto"},
  };
  for (const std::vector<std::string>& flags : cases) {
    const TemporaryFolder folder;
    write_sample(folder, "in.ply", torus_with_numbers());
    std::vector<std::string> with_recipe = flags;
    with_recipe.insert(with_recipe.end(), {"--write-recipe", "a.json"});
    bake(folder, "in.ply", "a.ply", with_recipe);
    bake(folder, "in.ply", "b.ply", {"--recipe", "a.ply"});
    bake(folder, "in.ply", "c.ply", {"--recipe", "a.json"});
    EXPECT_EQ(folder.read("b.ply"), folder.read("a.ply"));
    EXPECT_EQ(folder.read("c.ply"), folder.read("a.ply"));
    for (const std::string format : {"obj", "off"}) {
      bake(folder, "in.ply", "a." + format, flags);
      bake(folder, "in.ply", "from_" + format + ".ply", {"--recipe", "a." + format});
      EXPECT_EQ(folder.read("from_" + format + ".ply"), folder.read("a.ply")) << format;
    }
  }
}

TEST(Bake, FlagsOverrideTheRecipe) {
  const TemporaryFolder folder;
  write_sample(folder, "in.ply", sample_torus());
  bake(folder, "in.ply", "a.ply", {"--preset", "stone", "--frequency", "3", "--seed", "5"});
  bake(folder, "in.ply", "b.ply", {"--recipe", "a.ply", "--seed", "6"});
  bake(folder, "in.ply", "c.ply", {"--preset", "stone", "--frequency", "3", "--seed", "6"});
  EXPECT_NE(folder.read("b.ply"), folder.read("a.ply"));
  EXPECT_EQ(folder.read("b.ply"), folder.read("c.ply"));
}

TEST(Bake, TheNumberOfThreadsIsNowhereInTheBytes) {
  for (const std::string noise : {"surface", "oriented", "solid", "kensler", "kensler-solid"}) {
    const TemporaryFolder folder;
    write_sample(folder, "in.ply", sample_torus(24));
    for (const std::string threads : {"1", "2", "7"}) {
      bake(folder, "in.ply", threads + ".ply",
           {"--noise", noise, "--frequency", "9", "--refine", "1", "--displace", "0.01", "--threads",
            threads});
    }
    EXPECT_EQ(folder.read("2.ply"), folder.read("1.ply")) << noise;
    EXPECT_EQ(folder.read("7.ply"), folder.read("1.ply")) << noise;
  }
}

TEST(Bake, StandardOutputCarriesTheMeshAndNothingElse) {
  const TemporaryFolder folder;
  write_sample(folder, "in.obj", sample_torus());
  bake(folder, "in.obj", "file.ply");
  const ToolResult streamed = run_meshnoise({"bake", "in.obj", "--out", "-"}, {.folder = folder.path()});
  EXPECT_EQ(streamed.status, 0) << streamed.err;
  EXPECT_TRUE(streamed.out == folder.read("file.ply"));
  EXPECT_EQ(streamed.err.find('\r'), std::string::npos) << "a progress bar without a terminal";
}

}  // namespace
}  // namespace solidnoise::bake_test

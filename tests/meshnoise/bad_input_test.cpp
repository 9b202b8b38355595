#include <filesystem>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "meshnoise/run_meshnoise.h"
#include "meshnoise/sample_torus.h"
#include "tools/refusal.h"

namespace solidnoise::bad_input_test {
namespace {

constexpr char kPlane[] = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nf 1 2 4 3\n";

void write_bad_files(const TemporaryFolder& folder) {
  write_sample(folder, "in.ply", torus_with_numbers());
  folder.write("plane.obj", kPlane);
  folder.write("nan.obj", "v 0 0 0\nv 1 0 nan\nv 0 1 0\nf 1 2 3\n");
  folder.write("inf.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 -inf 0\n3 0 1 2\n");
  folder.write("index.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nf 1 2 9\n");
  folder.write("index.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 7\n");
  folder.write("empty.obj", "");
  folder.write("no_faces.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\n");
  folder.write("cut.ply", folder.read("in.ply").substr(0, folder.read("in.ply").size() - 100));
  folder.write("cut.off", "OFF\n3 2 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n");
  folder.write("cut.stl", "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0");
  folder.write("mesh.xyz", kPlane);
  folder.write("exists.ply", "precious");
  folder.write("broken.json", "{\"solidnoise\": 1, \n\"surface\": }");
  folder.write("range.json", R"({"solidnoise": 1, "bandwidth": -1})");
  folder.write("unknown.json", R"({"solidnoise": 1, "surfaces": {}})");
  folder.write("heat.json", R"({"solidnoise": 1, "bias": [0, 1], "by": {"attribute": "heat"}})");
  folder.write("example.json", R"({"solidnoise": 1, "exemplar": {"channels": [{"bands": [{"a": 0.1,
               "components": [[0.2, 0, 3, 0]]}]}]}})");
  std::filesystem::create_directory(folder.path() / "folder.ply");
  std::filesystem::create_symlink("in.ply", folder.path() / "link.obj");
}

class MeshnoiseBadInput : public testing::TestWithParam<Refusal> {};

// Arguments of bake follow "bake in.ply", if they begin with a flag.
TEST_P(MeshnoiseBadInput, IsRefusedInOneLineAndLeavesNothing) {
  const Refusal& refusal = GetParam();
  const TemporaryFolder folder;
  write_bad_files(folder);
  const std::set<std::string> before = folder.names();
  std::vector<std::string> arguments = refusal.arguments;
  if (!arguments.empty() && arguments[0].starts_with("-")) {
    arguments.insert(arguments.begin(), {"bake", "in.ply", "--quiet"});
  }

  const ToolResult result = run_meshnoise(arguments, {.folder = folder.path()});

  const bool is_command = !arguments.empty() && arguments[0] != "frobnicate";
  expect_refusal(result, refusal, is_command ? "meshnoise " + arguments[0] : "meshnoise");
  EXPECT_EQ(folder.names(), before);
  EXPECT_EQ(folder.read("exists.ply"), "precious");
}

const Refusal kUsage[] = {
    {"NoCommand", 2, {}, {"bake, curvature, info or farm"}},
    {"FarmOfTextures",
     2,
     {"farm", "in.ply", "--uv", "x.<UDIM>.png"},
     {"--uv is not for a farm's job, which makes meshes; meshnoise bake makes textures"}},
    {"UnknownCommand", 2, {"frobnicate", "in.ply"}, {"frobnicate", "bake, curvature, info or farm"}},
    {"NoMesh", 2, {"bake"}, {"IN is missing"}},
    {"UnknownFlag", 2, {"--out", "x.ply", "--frequncy", "3"}, {"--frequncy", "did you mean --frequency"}},
    {"StrayWord", 2, {"--out", "x.ply", "stray"}, {"stray"}},
    {"MissingValue", 2, {"--out", "x.ply", "--seed"}, {"--seed"}},
    {"GivenTwice", 2, {"--out", "x.ply", "--seed", "1", "--seed", "2"}, {"--seed"}},
    {"NoOutput", 2, {"--seed", "1"}, {"--out is missing"}},
    {"EmptyName", 2, {"--out", ""}, {"--out is empty"}},
    // Numbers
    {"NotANumber", 2, {"--out", "x.ply", "--frequency", "abc"}, {"--frequency is abc", "a number"}},
    {"Nan", 2, {"--out", "x.ply", "--frequency", "nan"}, {"--frequency is nan", "finite"}},
    {"RangeWithoutEnd", 2, {"--out", "x.ply", "--frequency", "4.."}, {"--frequency is 4..;", "4..32"}},
    {"RangeWithoutBegin", 2, {"--out", "x.ply", "--bias", "..4"}, {"--bias is ..4;", "4..32"}},
    {"RangeOfWords", 2, {"--out", "x.ply", "--size", "1..b"}, {"--size is 1..b;", "4..32"}},
    {"FrequencyNegative", 2, {"--out", "x.ply", "--frequency", "-1"}, {"--frequency is -1", "between"}},
    {"FrequencyZero", 2, {"--out", "x.ply", "--frequency", "4..0"}, {"--frequency is 0", "between"}},
    {"SizeZero", 2, {"--out", "x.ply", "--size", "0"}, {"--size is 0", "between"}},
    {"Detail", 2, {"--out", "x.ply", "--detail", "1e9"}, {"--detail is 1000000000", "between"}},
    {"Bandwidth", 2, {"--out", "x.ply", "--bandwidth", "0..1"}, {"--bandwidth is 0", "between 0.1 and 4"}},
    {"Magnitude", 2, {"--out", "x.ply", "--magnitude", "-1"}, {"--magnitude is -1", "between 0 and"}},
    {"Impulses", 2, {"--out", "x.ply", "--impulses", "-3"}, {"--impulses is -3", "between 0 and"}},
    {"Error", 2, {"--out", "x.ply", "--error", "2"}, {"--error is 2", "between"}},
    {"Layer", 2, {"--out", "x.ply", "--layer", "9"}, {"--layer is 9", "between 0.1 and 1"}},
    {"Octaves", 2, {"--out", "x.ply", "--octaves", "0"}, {"--octaves is 0", "between 1 and 16"}},
    {"Seed", 2, {"--out", "x.ply", "--seed", "-1"}, {"--seed is -1", "18446744073709551615"}},
    {"Percentiles", 2, {"--out", "x.ply", "--percentiles", "60", "40"}, {"--percentiles is 60 40", "less"}},
    {"Percentile", 2, {"--out", "x.ply", "--percentiles", "-1", "40"}, {"--percentiles is -1", "0 and 100"}},
    {"Gamma", 2, {"--out", "x.ply", "--gamma", "0"}, {"--gamma is 0", "greater than 0"}},
    {"Smooth", 2, {"--out", "x.ply", "--smooth", "-1"}, {"--smooth is -1", "between 0 and"}},
    {"RefineBudget",
     2,
     {"--out", "x.ply", "--refine-budget", "1000"},
     {"--refine-budget", "without --refine auto"}},
    {"BudgetBeyondMostVertices",
     2,
     {"--out", "x.ply", "--refine", "auto", "--refine-budget", "2000000000", "--feature-size", "0.0005"},
     {"--refine-budget is 2000000000; it must be between 0 and 50000000"}},
    {"FeatureSizeAndFrequency",
     2,
     {"--out", "x.ply", "--feature-size", "1", "--frequency", "2"},
     {"--feature-size", "--frequency"}},
    {"SmoothRadius", 2, {"--out", "x.ply", "--smooth-radius", "-1"}, {"--smooth-radius is -1", "at least 0"}},
    {"Contrast", 2, {"--out", "x.ply", "--contrast", "0"}, {"--contrast is 0", "greater than 0"}},
    {"Refine", 2, {"--out", "x.ply", "--refine", "much"}, {"--refine is much", "auto, off or a number"}},
    {"RefineTooOften", 2, {"--out", "x.ply", "--refine", "9"}, {"--refine is 9", "between 1 and 8"}},
    {"Displace", 2, {"--out", "x.ply", "--displace", "nan"}, {"--displace is nan", "finite"}},
    {"DisplaceToInfinity",
     2,
     {"--out", "x.ply", "--displace", "1e300"},
     {"--displace is 1e+300", "between -1000000000000 and 1000000000000"}},
    {"ThreadsZero", 2, {"--out", "x.ply", "--threads", "0"}, {"--threads is 0", "between 1 and"}},
    {"NoDirection",
     2,
     {"--out", "x.ply", "--noise", "oriented", "--direction", "0", "0", "0"},
     {"--direction is 0 0 0"}},
    // Words
    {"Noise", 2, {"--out", "x.ply", "--noise", "perlin"}, {"--noise is perlin", "surface, oriented, solid"}},
    {"Preset",
     2,
     {"--out", "x.ply", "--preset", "mud"},
     {"--preset is mud", "rust, scales, bark, stone, skin, moss, car-paint"}},
    {"Ramp", 2, {"--out", "x.ply", "--ramp", "mud"}, {"--ramp is \"mud\"", "viridis", "0:#000,1:#fff"}},
    {"RampColor", 2, {"--out", "x.ply", "--ramp", "0:#0g0,1:#fff"}, {"--ramp", "0:#0g0", "#RRGGBB"}},
    {"RampOrder", 2, {"--out", "x.ply", "--ramp", "1:#000,0:#fff"}, {"--ramp"}},
    {"Follow", 2, {"--out", "x.ply", "--follow", "up"}, {"--follow is up", "axis, max-curvature"}},
    {"Up", 2, {"--out", "x.ply", "--up", "x"}, {"--up is x", "y, z"}},
    {"Keep", 2, {"--out", "x.ply", "--keep", "mud"}, {"--keep is mud", "frequency, bandwidth"}},
    {"KeepNothing", 2, {"--out", "x.ply", "--keep", ""}, {"--keep is empty", "names"}},
    {"KeepAComma", 2, {"--out", "x.ply", "--keep", "bias,,weight"}, {"--keep is bias,,weight", "names"}},
    {"Preview", 2, {"--preview", "x.gif"}, {SOLIDNOISE_PREVIEWS ? "--preview is x.gif" : "Embree", ""}},
    // What has no effect, and contradictions
    {"ByWithoutARange", 2, {"--out", "x.ply", "--preset", "stone", "--by", "height"}, {"--by", "A..B"}},
    {"DirectionWithoutOriented",
     2,
     {"--out", "x.ply", "--direction", "0", "0", "1"},
     {"--direction", "oriented"}},
    {"KenslerBandwidth",
     2,
     {"--out", "x.ply", "--noise", "kensler", "--bandwidth", "1"},
     {"--bandwidth", "kensler"}},
    {"RefineShapeOfNone",
     2,
     {"--out", "x.ply", "--refine-shape", "smooth"},
     {"--refine-shape", "without --refine"}},
    {"RefineMethodOfNone",
     2,
     {"--out", "x.ply", "--refine-method", "loop"},
     {"--refine-method", "without --refine"}},
    {"RefineMethod",
     2,
     {"--out", "x.ply", "--refine", "1", "--refine-method", "catmull"},
     {"--refine-method is catmull", "longest-edge", "loop"}},
    {"RefineMethodWithAShape",
     2,
     {"--out", "x.ply", "--refine", "1", "--refine-method", "loop", "--refine-shape", "smooth"},
     {"smooth", "own"}},
    {"RefineShape",
     2,
     {"--out", "x.ply", "--refine", "1", "--refine-shape", "round"},
     {"--refine-shape is round", "edges", "smooth"}},
    {"ExampleIsMissing", 1, {"--out", "x.ply", "--noise", "none.json"}, {"none.json", "No such file"}},
    {"ExampleIsARecipe", 1, {"--out", "x.ply", "--noise", "heat.json"}, {"heat.json", "exemplar is missing"}},
    {"ExampleIsBroken", 1, {"--out", "x.ply", "--noise", "broken.json"}, {"broken.json", "line 2"}},
    {"ExampleWithABandwidth",
     2,
     {"--out", "x.ply", "--noise", "example.json", "--bandwidth", "2"},
     {"--bandwidth does not apply", "spectrum"}},
    {"ColorsOfNoExample", 2, {"--out", "x.ply", "--ramp", "exemplar"}, {"--ramp is exemplar", "by example"}},
    {"SolidLayer", 2, {"--out", "x.ply", "--noise", "solid", "--layer", "0.5"}, {"--layer", "surface"}},
    {"KeepWeightOfNone",
     2,
     {"--out", "x.ply", "--preset", "stone", "--keep", "weight"},
     {"--keep is weight", "range"}},
    {"KeepDirectionOfNone",
     2,
     {"--out", "x.ply", "--keep", "direction"},
     {"--keep is direction", "oriented"}},
    {"KeepInAnObj", 2, {"--out", "x.obj", "--keep", "bias"}, {"--keep", ".ply"}},
    {"SizeAndFrequency", 2, {"--out", "x.ply", "--size", "1", "--frequency", "2"}, {"--size", "--frequency"}},
    {"PresetAndRecipe",
     2,
     {"--out", "x.ply", "--preset", "rust", "--recipe", "r.json"},
     {"--preset", "--recipe"}},
    {"TwoOutputsOfOneName", 2, {"--out", "x.ply", "--write-recipe", "./x.ply"}, {"./x.ply", ".json"}},
    {"ExampleAsRecipe",
     2,
     {"--force", "--noise", "example.json", "--write-recipe", "./example.json"},
     {"./example.json is an input, which this output would replace"}},
    {"InputThroughALink",
     2,
     {"--force", "--out", "link.obj"},
     {"link.obj is an input, which this output would replace"}},
    {"TwoStandardOutputs", 2, {"--out", "-", "--write-recipe", "-"}, {"--out", "--write-recipe"}},
    // The other commands
    {"CurvatureOutput", 2, {"curvature", "in.ply"}, {"--out is missing"}},
    {"CurvatureIntoAnStl", 2, {"curvature", "nan.obj", "--out", "x.stl"}, {"--out is x.stl", ".ply"}},
    {"CurvatureIntoAPicture", 2, {"curvature", "nan.obj", "--out", "x.png"}, {"--out is x.png", ".ply"}},
    {"CurvatureBy", 2, {"curvature", "in.ply", "--out", "x.ply", "--by", "heat"}, {"--by is heat", "height"}},
    {"CurvatureRamp", 2, {"curvature", "in.ply", "--out", "x.ply", "--ramp", "mud"}, {"--ramp is \"mud\""}},
    {"CurvatureOfNothing", 2, {"curvature"}, {"IN"}},
    {"InfoOfNothing", 2, {"info"}, {"FILE"}},
    {"InfoFlag", 2, {"info", "in.ply", "--verbose"}, {"--verbose"}},
};

const Refusal kFiles[] = {
    {"MissingFile", 1, {"bake", "no.obj", "--out", "x.ply"}, {"no.obj", "No such file"}},
    {"AFolder", 1, {"bake", "folder.ply", "--out", "x.ply"}, {"folder.ply", "folder"}},
    {"UnknownFormat",
     1,
     {"bake", "mesh.xyz", "--out", "x.ply"},
     {"mesh.xyz", ".ply, .obj, .off, .stl and .om"}},
    {"PositionIsNan", 1, {"bake", "nan.obj", "--out", "x.ply"}, {"nan.obj:2: vertex 2", "finite"}},
    {"PositionIsInfinite", 1, {"bake", "inf.off", "--out", "x.ply"}, {"inf.off:5: vertex 2", "finite"}},
    {"NoSuchVertexInObj", 1, {"bake", "index.obj", "--out", "x.ply"}, {"index.obj:5: face 2", "index 9"}},
    {"NoSuchVertexInOff", 1, {"bake", "index.off", "--out", "x.ply"}, {"index.off:6: face 0", "vertex 7"}},
    {"EmptyFile", 1, {"bake", "empty.obj", "--out", "x.ply"}, {"empty.obj", "empty"}},
    {"NoFaces", 1, {"curvature", "no_faces.obj", "--out", "x.ply"}, {"no_faces.obj", "no faces"}},
    {"TruncatedPly", 1, {"bake", "cut.ply", "--out", "x.ply"}, {"cut.ply", "face"}},
    {"TruncatedOff", 1, {"bake", "cut.off", "--out", "x.ply"}, {"cut.off", "face 1 of 2"}},
    {"TruncatedStl", 1, {"bake", "cut.stl", "--out", "x.ply"}, {"cut.stl:5: face 0"}},
    {"DescribeReadsItToo", 1, {"bake", "nan.obj", "--describe"}, {"nan.obj:2: vertex 2"}},
    {"NoSuchAttribute", 1, {"--out", "x.ply", "--by", "rust"}, {"in.ply: --by is rust", "heat, label"}},
    {"NoAttributes", 1, {"bake", "plane.obj", "--out", "x.ply", "--by", "rust"}, {"plane.obj: --by is rust"}},
    {"NoSuchAttributeOfARecipe",
     1,
     {"bake", "plane.obj", "--out", "x.ply", "--recipe", "heat.json"},
     {"plane.obj: --by is heat"}},
    // Recipes
    {"NoRecipe", 1, {"--out", "x.ply", "--recipe", "no.json"}, {"no.json", "No such file"}},
    {"BrokenRecipe", 1, {"--out", "x.ply", "--recipe", "broken.json"}, {"broken.json", "line 2"}},
    {"RecipeOutOfRange",
     1,
     {"--out", "x.ply", "--recipe", "range.json"},
     {"range.json: line 1: bandwidth is -1"}},
    {"RecipeWithUnknownKey",
     1,
     {"--out", "x.ply", "--recipe", "unknown.json"},
     {"unknown.json: line 1: surfaces"}},
    {"MeshWithoutARecipe", 1, {"--out", "x.ply", "--recipe", "in.ply"}, {"in.ply", "no recipe"}},
    // Outputs
    {"IntoAnStl", 2, {"--out", "x.stl"}, {"--out is x.stl", ".ply, .obj, .off or .om"}},
    {"IntoAPicture", 2, {"--out", "x.png"}, {"--out is x.png", ".ply, .obj, .off or .om"}},
    {"OutputExists", 1, {"--out", "exists.ply"}, {"exists.ply", "--force"}},
    {"RecipeExists", 1, {"--out", "x.ply", "--write-recipe", "range.json"}, {"range.json", "--force"}},
    {"NoFolder", 1, {"--out", "nowhere/x.ply"}, {"nowhere"}},
    {"FolderIsAFile", 1, {"--out", "plane.obj/x.ply"}, {"plane.obj"}},
    {"UnwritableFolder", 1, {"--out", "/proc/x.ply"}, {"/proc"}},
    {"OutputIsAFolder", 1, {"--out", "folder.ply", "--force"}, {"folder.ply"}},
    {"CurvatureExists", 1, {"curvature", "in.ply", "--out", "exists.ply"}, {"exists.ply", "--force"}},
    {"CurvatureOfGarbage", 1, {"curvature", "cut.ply", "--out", "x.ply"}, {"cut.ply"}},
    {"InfoOfGarbage", 1, {"info", "cut.ply"}, {"cut.ply"}},
    {"InfoOfNoFile", 1, {"info", "no.ply"}, {"no.ply", "No such file"}},
};

const auto kName = [](const auto& refusal) { return refusal.param.name; };
INSTANTIATE_TEST_SUITE_P(Usage, MeshnoiseBadInput, testing::ValuesIn(kUsage), kName);
INSTANTIATE_TEST_SUITE_P(Files, MeshnoiseBadInput, testing::ValuesIn(kFiles), kName);

}  // namespace
}  // namespace solidnoise::bad_input_test

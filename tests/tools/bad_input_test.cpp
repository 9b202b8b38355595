#include <filesystem>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tools/refusal.h"
#include "tools/run_vdbnoise.h"

namespace solidnoise::bad_input_test {
namespace {

constexpr char kOpenMesh[] = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\nf 1 2 4\nf 2 3 4\n";

class BadInput : public testing::TestWithParam<Refusal> {};

TEST_P(BadInput, IsRefusedInOneLineAndLeavesNothing) {
  const Refusal& refusal = GetParam();
  const TemporaryFolder folder;
  folder.write("open.obj", kOpenMesh);
  folder.write("empty.obj", "");
  folder.write("no_faces.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\n");
  folder.write("garbage.vdb", "this is no volume at all, and never was one");
  folder.write("empty.vdb", "");
  folder.write(
      "flat.json",
      R"({"solidnoise": 2, "exemplar": {"channels": [{"bands": [{"a": 1, "components": [[1, 0, 1, 0]]}]}]}})");
  folder.write("exists.vdb", "precious");
  folder.write("broken.json", "{\"solidnoise\": 1, \n\"noise\": }");
  folder.write("bandwidth.json", R"({"solidnoise": 1, "noise": {"type": "gabor", "bandwidth": -1}})");
  folder.write("unknown.json", R"({"solidnoise": 1, "nose": {}})");
  folder.write("flat.json", R"({"solidnoise": 1, "exemplar": {"channels": [{"bands": [{"a": 0.1,
               "components": [[0.2, 0, 3, 0]]}]}]}})");
  folder.write("future.json", R"({"solidnoise": 99})");
  std::filesystem::create_directory(folder.path() / "folder.vdb");
  const std::set<std::string> before = folder.names();

  const ToolResult result = run_vdbnoise(refusal.arguments, {.folder = folder.path()});

  const std::string& first = refusal.arguments.empty() ? "" : refusal.arguments[0];
  const bool is_command = first == "info" || first == "analyze";
  expect_refusal(result, refusal, is_command ? "vdbnoise " + first : "vdbnoise");
  EXPECT_EQ(folder.names(), before);
  EXPECT_EQ(folder.read("exists.vdb"), "precious");
}

const Refusal kRefusals[] = {
    // The command line
    {"UnknownFlag", 2, {"--out", "x.vdb", "--frequncy", "3"}, {"--frequncy", "did you mean --frequency"}},
    {"UnknownShortFlag", 2, {"--out", "x.vdb", "-z"}, {"-z is not a flag"}},
    {"StrayWord", 2, {"--out", "x.vdb", "stray"}, {"stray"}},
    {"MissingValue", 2, {"--out", "x.vdb", "--voxel"}, {"--voxel", "UNITS"}},
    {"MissingValueBeforeAFlag", 2, {"--out", "--force"}, {"--out"}},
    {"TooFewValues", 2, {"--out", "x.vdb", "--box", "0", "0", "0"}, {"--box", "X0 Y0 Z0 X1 Y1 Z1"}},
    {"GivenTwice", 2, {"--out", "x.vdb", "--seed", "1", "--seed", "2"}, {"--seed"}},
    {"ValueForAToggle", 2, {"--out", "x.vdb", "--half=3"}, {"--half"}},
    {"NoOutput", 2, {}, {"--out"}},
    {"EmptyName", 2, {"--out", ""}, {"--out"}},
    // Numbers
    {"NoGenerators",
     2,
     {"--out", "x.vdb", "--noise", "kensler", "--generator", "auto"},
     {"--generator auto needs --noise gabor"}},
    {"NotANumber", 2, {"--out", "x.vdb", "--bandwidth", "abc"}, {"--bandwidth is abc", "number"}},
    {"HalfANumber", 2, {"--out", "x.vdb", "--frequency", "2x"}, {"--frequency is 2x", "number"}},
    {"Nan", 2, {"--out", "x.vdb", "--frequency", "nan"}, {"--frequency is nan", "finite"}},
    {"Infinite", 2, {"--out", "x.vdb", "--voxel", "inf"}, {"--voxel is inf", "finite"}},
    {"TooLargeForADouble", 2, {"--out", "x.vdb", "--frequency", "1e999"}, {"--frequency is 1e999"}},
    {"Hexadecimal", 2, {"--out", "x.vdb", "--frequency", "0x10"}, {"--frequency is 0x10"}},
    {"FractionForAnInteger", 2, {"--out", "x.vdb", "--octaves", "2.5"}, {"--octaves is 2.5", "whole number"}},
    {"NegativeSeed", 2, {"--out", "x.vdb", "--seed", "-1"}, {"--seed is -1", "18446744073709551615"}},
    {"NanInABox", 2, {"--out", "x.vdb", "--box", "0", "0", "0", "1", "nan", "1"}, {"--box is nan"}},
    // Ranges
    {"VoxelZero", 2, {"--out", "x.vdb", "--voxel", "0"}, {"--voxel is 0", "greater than 0"}},
    {"DimZero", 2, {"--out", "x.vdb", "--dim", "0"}, {"--dim is 0", "between 1 and"}},
    {"NegativeImpulses", 2, {"--out", "x.vdb", "--impulses", "-3"}, {"--impulses is -3", "between 0 and"}},
    {"NegativeBandwidth", 2, {"--out", "x.vdb", "--bandwidth", "-1"}, {"--bandwidth is -1", "octaves"}},
    {"FrequencyZero", 2, {"--out", "x.vdb", "--frequency", "0"}, {"--frequency is 0", "between"}},
    {"SizeZero", 2, {"--out", "x.vdb", "--size", "0"}, {"--size is 0", "between"}},
    {"ErrorTooLarge", 2, {"--out", "x.vdb", "--error", "2"}, {"--error is 2"}},
    {"NoOctaves", 2, {"--out", "x.vdb", "--octaves", "0"}, {"--octaves is 0"}},
    {"Lacunarity", 2, {"--out", "x.vdb", "--lacunarity", "0"}, {"--lacunarity is 0"}},
    {"FiveDimensions", 2, {"--out", "x.vdb", "--dims", "5"}, {"--dims is 5", "between 3 and 4"}},
    {"ThreadsZero", 2, {"--out", "x.vdb", "--threads", "0"}, {"--threads is 0"}},
    {"Puffs", 2, {"--out", "x.vdb", "--puffs", "0"}, {"--puffs is 0", "between 1 and 1000"}},
    {"CloudEdge", 2, {"--out", "x.vdb", "--cloud-edge", "0"}, {"--cloud-edge is 0", "greater than 0"}},
    {"WispsOfNoCloud",
     2,
     {"--out", "x.vdb", "--raw", "--wisps", "1"},
     {"--wisps does not apply to the shaping raw"}},
    {"OpticalDepth", 2, {"--out", "x.vdb", "--optical-depth", "-1"}, {"--optical-depth is -1"}},
    {"Density", 2, {"--out", "x.vdb", "--density", "0"}, {"--density is 0"}},
    {"BoxInsideOut", 2, {"--out", "x.vdb", "--box", "0", "0", "0", "1", "-1", "1"}, {"--box", "along y"}},
    {"Anisotropy",
     2,
     {"--out", "x.vdb", "--noise", "gabor-oriented", "--anisotropy", "2"},
     {"--anisotropy is 2", "between 0 and 1"}},
    {"NoDirection",
     2,
     {"--out", "x.vdb", "--noise", "gabor-oriented", "--direction", "0", "0", "0"},
     {"--direction is 0"}},
    {"PeriodNegative", 2, {"--out", "x.vdb", "--period", "-1", "0", "0"}, {"--period is -1"}},
    {"MemoryUnit", 2, {"--out", "x.vdb", "--max-memory", "3parsecs"}, {"--max-memory is 3parsecs", "8G"}},
    // Words
    {"Noise",
     2,
     {"--out", "x.vdb", "--noise", "perlin"},
     {"--noise is perlin", "gabor, gabor-oriented, kensler"}},
    {"FlatExample", 2, {"--out", "x.vdb", "--noise", "flat.json"}, {"of 2 dimensions", "of 3"}},
    {"ExampleIsMissing", 1, {"--out", "x.vdb", "--noise", "none.json"}, {"none.json", "No such file"}},
    {"ExampleIsARecipe", 1, {"--out", "x.vdb", "--noise", "bandwidth.json"}, {"exemplar is missing"}},
    {"ExampleWithABandwidth",
     2,
     {"--out", "x.vdb", "--noise", "flat.json", "--bandwidth", "2"},
     {"--bandwidth does not apply to --noise spectrum"}},
    {"Codec", 2, {"--out", "x.vdb", "--codec", "rar"}, {"--codec is rar", "blosc, zip, none"}},
    {"Shape", 2, {"--out", "x.vdb", "--shape", "teapot"}, {"--shape is teapot", "FILE.obj (or .ply"}},
    {"Preset", 2, {"--out", "x.vdb", "--preset", "fog"}, {"--preset is fog", "cumulus"}},
    {"Preview", 2, {"--preview", "x.gif"}, {"--preview is x.gif", ".png"}},
    // Contradictions
    {"SizeAndFrequency", 2, {"--out", "x.vdb", "--size", "1", "--frequency", "2"}, {"--size", "--frequency"}},
    {"VoxelAndDim", 2, {"--out", "x.vdb", "--voxel", "1", "--dim", "2"}, {"--voxel", "--dim"}},
    {"DensityAndDepth",
     2,
     {"--out", "x.vdb", "--density", "1", "--optical-depth", "2"},
     {"--density", "--optical-depth"}},
    {"RawAndDensity", 2, {"--out", "x.vdb", "--raw", "--density", "1"}, {"--raw", "--density"}},
    {"PresetAndRecipe",
     2,
     {"--out", "x.vdb", "--preset", "raw", "--recipe", "r.json"},
     {"--preset", "--recipe"}},
    {"RangeWithoutRaw", 2, {"--out", "x.vdb", "--range", "unit"}, {"--range", "--raw"}},
    {"TimeWithoutDims", 2, {"--out", "x.vdb", "--time", "2"}, {"--time is 2", "dims", "does not evolve"}},
    {"EvolveNegative", 2, {"--out", "x.vdb", "--evolve", "-1"}, {"--evolve is -1", "between 0 and"}},
    {"EvolveOfKensler",
     2,
     {"--out", "x.vdb", "--noise", "kensler", "--evolve", "1"},
     {"--evolve", "--noise kensler", "--dims 4"}},
    {"EvolveIn4D", 2, {"--out", "x.vdb", "--dims", "4", "--evolve", "1"}, {"--dims is 4", "evolves"}},
    {"BandLimitOfKensler",
     2,
     {"--out", "x.vdb", "--raw", "--noise", "kensler", "--band-limit"},
     {"--band-limit is true", "kensler"}},
    {"BandLimitIn4D",
     2,
     {"--out", "x.vdb", "--raw", "--dims", "4", "--band-limit"},
     {"--band-limit", "dims is 4"}},
    {"PeriodTooShort",
     2,
     {"--out", "x.vdb", "--raw", "--period", "0", "0.01", "0"},
     {"--period is 0.01 along y", "twice the kernel's radius"}},
    {"PeriodTooShortOfKensler",
     2,
     {"--out", "x.vdb", "--raw", "--noise", "kensler", "--period", "0", "0.01", "0"},
     {"--period is 0.01 along y", "4 steps of the lattice"}},
    {"PeriodThatDoesNotFitTheLacunarity",
     2,
     {"--out", "x.vdb", "--period", "9", "9", "9", "--octaves", "3", "--lacunarity", "2.5"},
     {"--lacunarity is 2.5", "whole number where there is a period"}},
    {"LoopOfNothing", 2, {"--out", "x.vdb", "--loop", "2"}, {"--loop", "--evolve or --dims 4"}},
    {"LoopNegative", 2, {"--out", "x.vdb", "--evolve", "1", "--loop", "-2"}, {"--loop is -2", "at least 0"}},
    {"LoopTooLong",
     2,
     {"--out", "x.vdb", "--evolve", "1000", "--loop", "1e6"},
     {"--loop is 1000000", "at most 1000"}},
    {"LoopTooShort",
     2,
     {"--out", "x.vdb", "--raw", "--dims", "4", "--loop", "0.01"},
     {"--loop is 0.01; it must be at least", "twice the kernel's radius"}},
    {"LoopOfOctavesThatDoNotFit",
     2,
     {"--out", "x.vdb", "--raw", "--dims", "4", "--loop", "4", "--octaves", "2", "--lacunarity", "1.5"},
     {"--lacunarity is 1.5", "whole number"}},
    {"LoopAndPeriod",
     2,
     {"--out", "x.vdb", "--dims", "4", "--loop", "4", "--period", "0", "0", "0", "3"},
     {"--loop", "--period"}},
    {"NotOfThisNoise",
     2,
     {"--out", "x.vdb", "--noise", "kensler", "--bandwidth", "1"},
     {"--bandwidth", "--noise kensler"}},
    {"BoxOfAMesh",
     2,
     {"--out", "x.vdb", "--shape", "open.obj", "--box", "0", "0", "0", "1", "1", "1"},
     {"--box", "--shape"}},
    {"VoxelOfAGrid", 2, {"--out", "x.vdb", "--shape", "garbage.vdb", "--voxel", "1"}, {"--voxel", "--shape"}},
    {"Output", 2, {"--out", "x.vdb", "--output", "flow"}, {"--output is flow", "value, gradient"}},
    {"OutputsThatDoNotMix", 2, {"--out", "x.vdb", "--output", "value,curl"}, {"--output is value,curl"}},
    {"OutputTwice", 2, {"--out", "x.vdb", "--output", "phase,phase"}, {"--output is phase,phase"}},
    {"GradientOfACloud",
     2,
     {"--out", "x.vdb", "--preset", "cumulus", "--output", "gradient"},
     {"--output is gradient", "raw"}},
    {"GradientOfARange",
     2,
     {"--out", "x.vdb", "--output", "gradient", "--range", "unit"},
     {"--output is gradient", "the range must be raw"}},
    {"PhaseOfGabor", 2, {"--out", "x.vdb", "--output", "phase"}, {"neither phase", "gabor-oriented"}},
    {"PhaseOfOctaves",
     2,
     {"--out", "x.vdb", "--output", "phase", "--noise", "gabor-oriented", "--octaves", "2"},
     {"--octaves is 2", "phase and intensity"}},
    {"NameOfTwoGrids",
     2,
     {"--out", "x.vdb", "--output", "value,gradient", "--grid", "a"},
     {"--output is value,gradient", "a grid that has a name, a, has one output"}},
    {"SpeedOfAValue", 2, {"--out", "x.vdb", "--speed", "2"}, {"--speed is 2", "output curl"}},
    {"SpeedZero", 2, {"--out", "x.vdb", "--output", "curl", "--speed", "0"}, {"--speed is 0"}},
    {"BoundaryOfAGradient",
     2,
     {"--out", "x.vdb", "--output", "gradient", "--boundary", "garbage.vdb"},
     {"--boundary", "output curl"}},
    {"BoundaryWidthAlone",
     2,
     {"--out", "x.vdb", "--output", "curl", "--boundary-width", "1"},
     {"--boundary-width", "--boundary"}},
    {"BoundaryWidthZero",
     2,
     {"--out", "x.vdb", "--output", "curl", "--boundary", "garbage.vdb", "--boundary-width", "0"},
     {"--boundary-width is 0"}},
    {"BoundaryIsNoVolume",
     2,
     {"--out", "x.vdb", "--output", "curl", "--boundary", "open.obj"},
     {"--boundary is open.obj", "FILE.vdb"}},
    {"OutputOnAGrid",
     2,
     {"--out", "x.vdb", "--on", "garbage.vdb", "--output", "gradient"},
     {"--output is gradient", "must be value"}},
    // Files
    {"NoBoundary", 1, {"--out", "x.vdb", "--output", "curl", "--boundary", "missing.vdb"}, {"missing.vdb"}},
    {"NoMesh", 1, {"--out", "x.vdb", "--shape", "missing.obj"}, {"missing.obj", "No such file"}},
    {"OpenMesh", 1, {"--out", "x.vdb", "--shape", "open.obj"}, {"open.obj", "edge"}},
    {"FlatModel",
     2,
     {"--out", "x.vdb", "--raw", "--noise", "flat.json"},
     {"--noise is flat.json: the spectrum is of 2 dimensions; it must be of 3"}},
    {"EmptyMesh", 1, {"--out", "x.vdb", "--shape", "empty.obj"}, {"empty.obj"}},
    {"MeshWithoutFaces", 1, {"--out", "x.vdb", "--shape", "no_faces.obj"}, {"no_faces.obj"}},
    {"NoGrid", 1, {"--out", "x.vdb", "--shape", "missing.vdb"}, {"missing.vdb"}},
    {"GarbageGrid", 1, {"--out", "x.vdb", "--shape", "garbage.vdb"}, {"garbage.vdb"}},
    {"EmptyGrid", 1, {"--out", "x.vdb", "--shape", "empty.vdb"}, {"empty.vdb"}},
    {"NoRecipe", 1, {"--out", "x.vdb", "--recipe", "missing.json"}, {"missing.json", "No such file"}},
    {"RecipeIsAFolder", 1, {"--out", "x.vdb", "--recipe", "."}, {"."}},
    {"BrokenRecipe", 1, {"--out", "x.vdb", "--recipe", "broken.json"}, {"broken.json", "line 2"}},
    {"RecipeOutOfRange",
     1,
     {"--out", "x.vdb", "--recipe", "bandwidth.json"},
     {"bandwidth.json: line 1: noise.bandwidth is -1"}},
    {"RecipeWithUnknownKey",
     1,
     {"--out", "x.vdb", "--recipe", "unknown.json"},
     {"unknown.json: line 1: nose"}},
    {"RecipeOfTheFuture",
     1,
     {"--out", "x.vdb", "--recipe", "future.json"},
     {"future.json: line 1: solidnoise is 99"}},
    {"GarbageRecipe", 1, {"--out", "x.vdb", "--recipe", "garbage.vdb"}, {"garbage.vdb"}},
    {"OutputExists", 1, {"--out", "exists.vdb", "--dim", "8"}, {"exists.vdb", "--force"}},
    {"TwoOutputsOfOneName",
     2,
     {"--out", "x.vdb", "--write-recipe", "./x.vdb", "--dim", "8"},
     {"./x.vdb", "two outputs"}},
    {"PreviewExists", 1, {"--out", "x.vdb", "--write-recipe", "broken.json"}, {"broken.json", "--force"}},
    {"NoFolder", 1, {"--out", "nowhere/x.vdb", "--dim", "8"}, {"nowhere"}},
    {"FolderIsAFile", 1, {"--out", "open.obj/x.vdb", "--dim", "8"}, {"open.obj"}},
    {"UnwritableFolder", 1, {"--quiet", "--out", "/proc/x.vdb", "--dim", "8"}, {"/proc"}},
    {"OutputIsAPicture", 2, {"--out", "a.png", "--dim", "8"}, {"--out", "a.png", ".vdb"}},
    {"OutputIsAFolder", 1, {"--out", "folder.vdb", "--force", "--dim", "8"}, {"folder.vdb"}},
    // Memory
    {"MaxMemory",
     1,
     {"--out", "x.vdb", "--dim", "64", "--max-memory", "100K"},
     {"--max-memory", "100.0 KiB"}},
    {"AvailableMemory",
     1,
     {"--raw", "--out", "x.vdb", "--dim", "100000"},
     {"100000 x 100000 x 100000", "--max-memory"}},
    // The other commands
    {"InfoWithoutFile", 2, {"info"}, {"FILE"}},
    {"InfoMissing", 1, {"info", "missing.vdb"}, {"missing.vdb"}},
    {"InfoGarbage", 1, {"info", "garbage.vdb"}, {"garbage.vdb"}},
    {"InfoUnknownFlag", 2, {"info", "garbage.vdb", "--verbose"}, {"--verbose"}},
    {"AnalyzeWithoutFile", 2, {"analyze"}, {"FILE"}},
    {"AnalyzeMissing", 1, {"analyze", "missing.vdb"}, {"missing.vdb"}},
    {"AnalyzeGarbage", 1, {"analyze", "garbage.vdb"}, {"garbage.vdb"}},
};

INSTANTIATE_TEST_SUITE_P(Vdbnoise, BadInput, testing::ValuesIn(kRefusals),
                         [](const auto& refusal) { return refusal.param.name; });

// A word of 4000 bytes is echoed up to 80 of them.
TEST(LongValue, IsShortenedInTheMessage) {
  const TemporaryFolder folder;
  std::string value;
  for (int i = 0; i < 2000; ++i) value += "\u00e9";
  const ToolResult result = run_vdbnoise({"--raw", "--preview", value}, {.folder = folder.path()});
  EXPECT_EQ(result.status, 2);
  EXPECT_NE(result.err.find("--preview"), std::string::npos) << result.err;
  EXPECT_LT(result.err.size(), 250U);
}

// Damaged files end in a message, never in a signal. The seed of the damage is fixed: 16 cuts, 16 flips.
TEST(DamagedInput, VolumesAreRefusedOrRead) {
  const TemporaryFolder folder;
  ASSERT_EQ(run_vdbnoise({"--raw", "--dim", "16", "--quiet", "--out", folder.file("whole.vdb")}).status, 0);
  const std::string whole = folder.read("whole.vdb");
  for (std::size_t i = 0; i < 16; ++i) {
    folder.write("damaged.vdb", whole.substr(0, whole.size() * i / 16));
    const ToolResult cut =
        run_vdbnoise({"--shape", "damaged.vdb", "--out", "x.vdb"}, {.folder = folder.path()});
    EXPECT_EQ(cut.status, 1) << "cut at " << i << "/16: " << cut.err;
    EXPECT_NE(cut.err.find("damaged.vdb"), std::string::npos) << cut.err;

    std::string flipped = whole;
    flipped[whole.size() * (2 * i + 1) / 32] ^= static_cast<char>(1 << (i % 8));
    folder.write("damaged.vdb", flipped);
    const ToolResult flip = run_vdbnoise({"info", "damaged.vdb"}, {.folder = folder.path()});
    EXPECT_EQ(flip.signal, 0) << "flip at " << i << "/16";
  }
  EXPECT_EQ(folder.names(), (std::set<std::string>{"whole.vdb", "damaged.vdb"}));
}

}  // namespace
}  // namespace solidnoise::bad_input_test

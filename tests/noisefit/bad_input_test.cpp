#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "noisefit/run_noisefit.h"
#include "support/temporary_folder.h"
#include "tools/expect_whole_or_nothing.h"
#include "tools/refusal.h"

namespace solidnoise::bad_input_test {
namespace {

const std::vector<Refusal> kRefusals = {
    {"NoArguments", 2, {}, {"IN is missing"}},
    {"NoOutput", 2, {"in.png"}, {"--out is missing"}},
    {"Memory", 1, {"in.png", "--max-memory", "10M", "--out", "x.json"}, {"--max-memory allows 10.0 MiB"}},
    {"Time",
     1,
     {"in.png", "--max-time", "0.001", "--out", "x.json"},
     {" samples may take ", "--max-time allows 0.001"}},
    {"NoSuchFile", 1, {"none.png", "--out", "x.json"}, {"none.png"}},
    {"NotAPicture", 1, {"text.png", "--out", "x.json"}, {"text.png"}},
    {"AVolume", 1, {"volume.vdb", "--out", "x.json"}, {"volume.vdb", "PNG, JPEG, TIFF, OpenEXR"}},
    {"NoFile",
     1,
     {"x.null?RES=64x64x64&CHANNELS=1", "--out", "x.json"},
     {"x.null?RES=64x64x64", "No such file"}},
    {"TooSmall", 1, {"small.png", "--out", "x.json"}, {"small.png", "12 samples", "at least 16"}},
    {"Constant", 1, {"constant.png", "--out", "x.json"}, {"constant.png", "is constant"}},
    {"Transparent", 1, {"alpha.png", "--out", "x.json"}, {"alpha.png", "alpha channel", "flatten"}},
    {"NotFinite", 1, {"nan.exr", "--out", "x.json"}, {"nan.exr", "not finite"}},
    {"KappaZero", 2, {"in.png", "--out", "x.json", "--kappa", "0"}, {"--kappa is 0"}},
    {"KappaWord", 2, {"in.png", "--out", "x.json", "--kappa", "some"}, {"--kappa", "some"}},
    {"PixelSize", 2, {"in.png", "--out", "x.json", "--pixel-size", "-1"}, {"--pixel-size is -1"}},
    {"Patch", 2, {"in.png", "--out", "x.json", "--patch", "4"}, {"--patch is 4", "16"}},
    {"Exists", 1, {"in.png", "--out", "model.json"}, {"model.json exists", "--force"}},
    {"OneOutputTwice", 2, {"in.png", "--out", "x.png", "--preview", "x.png"}, {"--out is x.png", ".json"}},
    {"OtherName", 2, {"in.png", "--out", "x.txt"}, {"--out is x.txt; it must end in .json, or be -"}},
    {"OtherPicture", 2, {"in.png", "--out", "x.json", "--preview", "0"}, {"--preview is 0", ".png"}},
    {"InputAsPreview",
     2,
     {"in.png", "--preview", "in.png", "--force"},
     {"in.png is an input, which this output would replace"}},
    {"InputByALink", 2, {"in.png", "--preview", "link.png", "--force"}, {"link.png is an input"}},
    {"LongValue",
     2,
     {"in.png", "--out", "x.json", "--kappa", std::string(5000, 'x')},
     {"--kappa is " + std::string(80, 'x') + "...; it must be a number"}},
    {"Escape", 2, {"in.png", "--out", "x.json", "--kappa", "\x1b[2J"}, {"--kappa is \\x1b[2J"}},
};

const std::vector<Refusal> kEditRefusals = {
    {"NothingToDo", 2, {"edit", "model.json", "--out", "x.json"}, {"nothing to do"}},
    {"NoOutput", 2, {"edit", "model.json", "--rotate", "3"}, {"--out is missing"}},
    {"NoGroup",
     2,
     {"edit", "model.json", "--out", "x.json", "--rotate", "3", "--group", "no"},
     {"no group no"}},
    {"NoChannel",
     2,
     {"edit", "model.json", "--out", "x.json", "--rotate", "3", "--channel", "4"},
     {"--channel is 4"}},
    {"NegativeScale", 2, {"edit", "model.json", "--out", "x.json", "--scale", "-2"}, {"scale is -2"}},
    {"SmallScale",
     2,
     {"edit", "model.json", "--out", "x.json", "--scale", "1e-308"},
     {"--scale: model.json: channel 0: scale is 1e-308; it must be between 1e-09 and 1000000000"}},
    {"LargeScale", 2, {"edit", "model.json", "--out", "x.json", "--scale", "1e300"}, {"scale is 1e+300"}},
    {"Bandwidth",
     2,
     {"edit", "model.json", "--out", "x.json", "--bandwidth", "1e30"},
     {"bandwidth is 1e+30; it must be between 1e-09 and 1000000000"}},
    {"Magnitude",
     2,
     {"edit", "model.json", "--out", "x.json", "--magnitude", "1e-30"},
     {"magnitude is 1e-30"}},
    {"Translation",
     2,
     {"edit", "model.json", "--out", "x.json", "--translate", "1e308", "1e308"},
     {"--translate: model.json: channel 0: bands[0].components[0].frequency is inf"}},
    {"FarTranslation",
     2,
     {"edit", "model.json", "--out", "x.json", "--translate", "1e20", "0"},
     {"frequency is 1e+20; it must be between 0 and 1e+16 (cycles per world unit)"}},
    {"NarrowBand",
     2,
     {"edit", "model.json", "--out", "x.json", "--add", "1e-300", "1", "0.1", "0.1"},
     {"--add: model.json: channel 0: bands[1].a is 1e-300; it must be between 1e-16 and 1e+16"}},
    {"NarrowerThanTheRest",
     2,
     {"edit", "model.json", "--out", "x.json", "--add", "1e-9", "1", "0.1", "0.1"},
     {"bands[1].a is 1e-09; it must be between 1e-06 and 1000000 times the principal frequency, 0.14"}},
    {"HugeVariance",
     2,
     {"edit", "model.json", "--out", "x.json", "--add", "0.1", "1e300", "0.1", "0.1"},
     {"add up to 1e+300; the sum must be between 1e-60 and 1e+60"}},
    {"NarrowFile",
     1,
     {"edit", "narrow.json", "--out", "x.json", "--scale", "2"},
     {"narrow.json", "exemplar.channels[0].bands[0].a is 1e-300"}},
    {"Negative",
     1,
     {"edit", "negative.json", "--out", "x.json", "--scale", "2"},
     {"negative.json", "variance"}},
    {"Version",
     1,
     {"edit", "version.json", "--out", "x.json", "--scale", "2"},
     {"version.json", "solidnoise"}},
};

class NoisefitRefuses : public testing::Test {
 protected:
  void SetUp() override {
    write_image(folder_ / "in.png", wavy_picture(32, 32));
    write_image(folder_ / "small.png", wavy_picture(32, 12));
    write_image(folder_ / "constant.png", Image(32, 32, 3));
    write_image(folder_ / "alpha.png", wavy_picture(32, 32, 4));
    Image broken = wavy_picture(32, 32);
    broken.at(4, 4) = std::nanf("");
    write_image(folder_ / "nan.exr", broken, {.color_space = ColorSpace::linear});
    folder_.write("text.png", "no picture");
    folder_.write("volume.vdb", std::string(" BDV\0\0\0\0", 8) + std::string(5000, '\0'));
    std::string model =
        "\"exemplar\": {\"raw_values\": false, \"mean\": [0, 0, 0], \"channels\": [{\"axis\": [1, 1, 1], "
        "\"dimensions\": 2, \"isotropic\": false, \"groups\": [\"all\"], \"bands\": [{\"a\": 0.1, "
        "\"components\": "
        "[[0.1, 0.1, ";
    const std::string end = ", 0]]}]}]}}";
    folder_.write("model.json", "{\"solidnoise\": 1, \"algorithm\": 1, " + model + "1" + end);
    folder_.write("negative.json", "{\"solidnoise\": 1, \"algorithm\": 1, " + model + "-1" + end);
    folder_.write("version.json", "{\"solidnoise\": 99, \"algorithm\": 1, " + model + "1" + end);
    folder_.write("narrow.json", "{\"solidnoise\": 1, \"algorithm\": 1, " +
                                     model.replace(model.find("0.1"), 3, "1e-300") + "1" + end);
    std::filesystem::create_symlink("in.png", folder_ / "link.png");
    files_ = folder_.names();
  }

  void refuse(const std::vector<Refusal>& refusals, const std::string& command) {
    for (const Refusal& refusal : refusals) {
      SCOPED_TRACE(refusal.name);
      expect_refusal(run_noisefit(refusal.arguments, {.folder = folder_.path()}), refusal, command);
      EXPECT_EQ(folder_.names(), files_);
    }
  }

  TemporaryFolder folder_;
  std::set<std::string> files_;
};

TEST_F(NoisefitRefuses, BadExemplarsAndFlags) {
  refuse(kRefusals, "noisefit");
}

TEST_F(NoisefitRefuses, BadFilesAndEdits) {
  refuse(kEditRefusals, "noisefit edit");
}

TEST(NoisefitFullDisk, OfTheStandardOutputIsReported) {
  const TemporaryFolder folder;
  write_image(folder / "in.png", wavy_picture(32, 32));
  ASSERT_EQ(run_noisefit({"in.png", "--out", "x.json"}, {.folder = folder.path()}).status, 0);
  for (const std::vector<std::string>& arguments :
       {std::vector<std::string>{"--help"}, {"--version"}, {"info", "x.json"}, {"in.png", "--out", "-"}}) {
    const ToolResult result =
        run_noisefit(arguments, {.folder = folder.path(), .standard_output = "/dev/full"});
    EXPECT_EQ(result.status, 1) << arguments[0];
    EXPECT_NE(result.err.find("noisefit: standard output: writing failed"), std::string::npos) << result.err;
  }
}

TEST(NoisefitFaults, LeaveAllOutputsOrNone) {
  const TemporaryFolder folder;
  write_image(folder / "in.png", wavy_picture(32, 32, 1));
  expect_whole_or_nothing(
      [](const RunOptions& options) {
        return run_noisefit({"in.png", "--raw-values", "--quiet", "--out", "x.json"}, options);
      },
      folder);
}

}  // namespace
}  // namespace solidnoise::bad_input_test

#include <cstdlib>
#include <filesystem>
#include <stdexcept>
#include <string>

#include <gtest/gtest.h>

#include "solidnoise/image/image_file.h"
#include "support/paths.h"
#include "support/temporary_folder.h"

namespace solidnoise::image_module_test {
namespace {

// In a process of its own: the module is looked for once.
TEST(ImageModuleDeathTest, AMissingModuleIsNamedInTheError) {
  testing::GTEST_FLAG(death_test_style) = "threadsafe";
  EXPECT_EXIT(
      {
        setenv("SOLIDNOISE_IMAGE_MODULE", "/nowhere/module.so", 1);
        try {
          write_image("a.png", Image(1, 1, 1));
        } catch (const std::runtime_error& error) {
          const std::string message = error.what();
          const bool clear = message.find("/nowhere/module.so") != std::string::npos &&
                             message.find("SOLIDNOISE_IMAGE_MODULE") != std::string::npos;
          std::_Exit(clear ? 0 : 1);
        }
        std::_Exit(2);
      },
      testing::ExitedWithCode(0), "");
}

TEST(ImageModule, IsFoundBesideTheLibraryThatWasLoaded) {
  const TemporaryFolder folder;
  const auto copy = [&](const std::string& from, const std::string& to) {
    std::filesystem::create_directories((folder / to).parent_path());
    std::filesystem::copy_file(in_build(from), folder / to);
  };
  copy("tests/picture_program", "elsewhere/program");
  copy("tests/libpicture_host.so", "lib/libpicture_host.so");
  const auto run = [&] {
    const std::string command = "cd '" + folder.path().string() +
                                "' && env -u SOLIDNOISE_IMAGE_MODULE LD_LIBRARY_PATH=lib elsewhere/program";
    return std::system(command.c_str());
  };
  if (run() == 0) GTEST_SKIP() << "there is an installed module";
  copy("lib/solidnoise/solidnoise_image_io.so", "lib/solidnoise/solidnoise_image_io.so");
  EXPECT_EQ(run(), 0);
  EXPECT_EQ(folder.names().count("x.png"), 1u);
}

}  // namespace
}  // namespace solidnoise::image_module_test

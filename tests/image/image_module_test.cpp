#include <cstdlib>
#include <stdexcept>
#include <string>

#include <gtest/gtest.h>

#include "solidnoise/image/image_file.h"

namespace solidnoise {
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

}  // namespace
}  // namespace solidnoise

#include "solidnoise/core/input_file.h"

#include <stdexcept>
#include <string>
#include <sys/stat.h>
#include <thread>

#include <gtest/gtest.h>

#include "support/message_of.h"
#include "support/temporary_folder.h"

namespace solidnoise::input_file_test {
namespace {

TEST(ReadFile, HasAllBytes) {
  const TemporaryFolder folder;
  for (const std::size_t size : {0u, 1u, 65535u, 65536u, 300000u}) {
    std::string bytes(size, '\0');
    for (std::size_t i = 0; i < size; ++i) bytes[i] = static_cast<char>(i % 251);
    folder.write("a", bytes);
    EXPECT_TRUE(read_file(folder / "a", size) == bytes) << size;
  }
}

TEST(ReadFile, ReadsAPipeToItsEnd) {
  const TemporaryFolder folder;
  ASSERT_EQ(mkfifo((folder / "pipe").c_str(), 0600), 0);
  const std::string bytes(200000, 'x');
  std::thread writer([&] { folder.write("pipe", bytes); });
  EXPECT_TRUE(read_file(folder / "pipe", 1u << 20) == bytes);
  writer.join();
}

TEST(ReadFile, RefusesWhatIsNoFileOrTooLong) {
  const TemporaryFolder folder;
  folder.write("a", "12345");
  std::filesystem::create_symlink("/dev/zero", folder / "endless");
  const auto refusal = [&](const char* name) {
    return message_of<std::runtime_error>([&] { read_file(folder / name, 4); });
  };
  const std::string here = folder.path().string();
  EXPECT_EQ(refusal("a"), here + "/a: has more than 4 bytes");
  EXPECT_EQ(refusal("."), here + "/.: is a folder, not a file");
  EXPECT_EQ(refusal("endless"), here + "/endless: is a device, not a file");
  EXPECT_EQ(refusal("none"), here + "/none: cannot be read: No such file or directory");
}

}  // namespace
}  // namespace solidnoise::input_file_test

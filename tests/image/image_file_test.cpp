#include "solidnoise/image/image_file.h"

#include <algorithm>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <stdexcept>
#include <string>
#include <sys/resource.h>
#include <unistd.h>

#include <fmt/chrono.h>
#include <gtest/gtest.h>

#include "solidnoise/core/random.h"
#include "support/temporary_folder.h"

namespace solidnoise::image_file_test {
namespace {

namespace fs = std::filesystem;

bool openimageio_is_loaded() {
  std::ifstream maps("/proc/self/maps");
  std::string line;
  while (std::getline(maps, line)) {
    if (line.find("OpenImageIO") != std::string::npos) return true;
  }
  return false;
}

// Asked before main runs, when all that is linked has been loaded.
const bool kLoadedAtStart = openimageio_is_loaded();

class ImageFile : public testing::Test {
 protected:
  TemporaryFolder folder_;
};

Image random_image(int width, int height, int channels) {
  Image image(width, height, channels);
  RandomStream stream(7);
  for (float& value : image.pixels) value = static_cast<float>(stream.next_unit());
  return image;
}

float largest_difference(const Image& a, const Image& b) {
  EXPECT_EQ(a.width, b.width);
  EXPECT_EQ(a.height, b.height);
  EXPECT_EQ(a.channels, b.channels);
  if (a.pixels.size() != b.pixels.size()) return std::numeric_limits<float>::infinity();
  float largest = 0.0f;
  for (std::size_t i = 0; i < a.pixels.size(); ++i) {
    largest = std::max(largest, std::abs(a.pixels[i] - b.pixels[i]));
  }
  return largest;
}

template <typename Function>
std::string message_of(Function function) {
  try {
    function();
  } catch (const std::exception& error) {
    return error.what();
  }
  return "no error";
}

TEST_F(ImageFile, OpenImageIoIsLoadedByTheFirstUseAndNotBefore) {
  EXPECT_FALSE(kLoadedAtStart);

  write_image(folder_ / "a.png", random_image(4, 4, 1));

  EXPECT_TRUE(openimageio_is_loaded());
}

TEST_F(ImageFile, PngOf8BitsKeepsPixelsToHalfAStep) {
  const Image image = random_image(33, 17, 3);
  write_image(folder_ / "a.png", image);
  EXPECT_LE(largest_difference(read_image(folder_ / "a.png"), image), 0.5f / 255.0f + 1e-6f);
}

TEST_F(ImageFile, PngOf16BitsKeepsPixelsToHalfAStep) {
  const Image image = random_image(33, 17, 1);
  write_image(folder_ / "a.png", image, {SampleType::uint16, ColorSpace::linear});
  EXPECT_LE(largest_difference(read_image(folder_ / "a.png"), image), 0.5f / 65535.0f + 1e-6f);
}

TEST_F(ImageFile, ExrKeepsFloatsExactly) {
  Image image = random_image(20, 30, 4);
  image.pixels[5] = -12.5f;
  image.pixels[6] = 1e6f;
  write_image(folder_ / "a.exr", image, {SampleType::automatic, ColorSpace::linear});
  EXPECT_EQ(read_image(folder_ / "a.exr").pixels, image.pixels);
}

TEST_F(ImageFile, HalfExrKeepsElevenBits) {
  const Image image = random_image(20, 30, 3);
  write_image(folder_ / "a.exr", image, {SampleType::float16, ColorSpace::linear});
  EXPECT_LE(largest_difference(read_image(folder_ / "a.exr"), image), 0x1.0p-12f);
}

TEST_F(ImageFile, TiffKeeps16Bits) {
  const Image image = random_image(20, 30, 3);
  write_image(folder_ / "a.tif", image);
  EXPECT_LE(largest_difference(read_image(folder_ / "a.tif"), image), 0.5f / 65535.0f + 1e-6f);
}

TEST_F(ImageFile, SaysNothingOfWhenItWasWritten) {
  for (const std::string name : {"a.exr", "a.tif", "a.png", "a.jpg"}) {
    write_image(folder_ / name, random_image(4, 4, 3));
    std::ifstream file(folder_ / name, std::ios::binary);
    const std::string bytes{std::istreambuf_iterator<char>(file), {}};
    EXPECT_EQ(bytes.find(fmt::format("{:%Y:%m:%d}", fmt::localtime(std::time(nullptr)))), std::string::npos)
        << name;
  }
}

TEST_F(ImageFile, RowZeroIsAtTheTop) {
  Image image(2, 2, 1);
  image.at(1, 0) = 1.0f;
  write_image(folder_ / "a.png", image);
  EXPECT_EQ(read_image(folder_ / "a.png").pixels, (std::vector<float>{0.0f, 1.0f, 0.0f, 0.0f}));
}

TEST_F(ImageFile, JpegIsWrittenAndReadable) {
  Image image(16, 16, 3);
  std::fill(image.pixels.begin(), image.pixels.end(), 0.5f);
  write_image(folder_ / "a.jpg", image);
  // A flat picture is exact up to 8 bits and JPEG's integer colour conversion, a step each.
  EXPECT_LE(largest_difference(read_image(folder_ / "a.jpg"), image), 2.0f / 255.0f);
}

TEST_F(ImageFile, WritingLeavesNothingButTheFile) {
  write_image(folder_ / "a.png", random_image(4, 4, 1));
  write_image(folder_ / "a.png", random_image(5, 5, 1), {.existing = Existing::replace});
  EXPECT_EQ(read_image(folder_ / "a.png").width, 5);
  EXPECT_EQ(folder_.count(), 1u);
}

// Links that others may have put where pictures go lead nowhere that is written to.
TEST_F(ImageFile, OthersFilesAreNotReplaced) {
  folder_.write("victim", "precious");
  for (const std::string& name : {std::string("a.png"), ".a." + std::to_string(getpid()) + ".png"}) {
    fs::create_symlink("victim", folder_ / name);
  }
  EXPECT_THROW(write_image(folder_ / "a.png", random_image(4, 4, 1)), OutputExists);
  EXPECT_EQ(folder_.read("victim"), "precious");
  fs::remove(folder_ / "a.png");
  write_image(folder_ / "a.png", random_image(4, 4, 1));
  EXPECT_EQ(folder_.read("victim"), "precious");
  EXPECT_THROW(write_image(folder_ / "a.png", random_image(4, 4, 1)), OutputExists);
}

TEST_F(ImageFile, AWriteThatIsCutShortIsReportedAndLeavesTheOldFile) {
  write_image(folder_ / "a.png", random_image(4, 4, 1));
  const Image large = random_image(300, 300, 3);

  // A limit on the file size stands for a full disk: writes fail half-way.
  rlimit previous{};
  ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &previous), 0);
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  rlimit small = previous;
  small.rlim_cur = 100 * 1024;
  ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &small), 0);
  testing::internal::CaptureStderr();
  const std::string png =
      message_of([&] { write_image(folder_ / "a.png", large, {.existing = Existing::replace}); });
  const std::string exr = message_of([&] { write_image(folder_ / "b.exr", large); });
  const std::string printed = testing::internal::GetCapturedStderr();
  setrlimit(RLIMIT_FSIZE, &previous);
  std::signal(SIGXFSZ, handler);

  EXPECT_EQ(printed, "");
  EXPECT_EQ(png, folder_.file("a.png") + ": writing failed: File too large");
  EXPECT_EQ(exr, folder_.file("b.exr") + ": writing failed: File too large");
  EXPECT_EQ(read_image(folder_ / "a.png").width, 4);
  EXPECT_EQ(folder_.count(), 1u);
}

// Asks to stop once it has been asked so often.
class StopsAt final : public Progress {
 public:
  explicit StopsAt(int question) : question_(question) {}
  void advance(std::uint64_t, std::uint64_t) override {}
  bool cancelled() override { return ++asked_ >= question_; }

 private:
  int question_;
  int asked_ = 0;
};

TEST_F(ImageFile, StopsWhereACallerAsksTo) {
  const Image image = random_image(300, 300, 3);
  for (const std::string name : {"a.png", "a.jpg", "a.tif", "a.exr"}) {
    StopsAt first(1);
    EXPECT_THROW(write_image(folder_ / name, image, {.progress = &first}), Cancelled) << name;
    EXPECT_EQ(folder_.count(), 0u);
    write_image(folder_ / name, image);
    for (int question : {1, 2}) {
      StopsAt later(question);
      EXPECT_THROW(read_image(folder_ / name, &later), Cancelled) << name;
    }
    StopsAt never(1000);
    EXPECT_EQ(read_image(folder_ / name, &never).pixels, read_image(folder_ / name).pixels);
    fs::remove(folder_ / name);
  }
}

TEST_F(ImageFile, AMissingFolderIsNamed) {
  const fs::path path = folder_ / "none" / "a.png";
  const std::string message = message_of([&] { write_image(path, random_image(2, 2, 1)); });
  EXPECT_EQ(message, path.string() + ": there is no folder " + path.parent_path().string());
}

TEST_F(ImageFile, UnknownExtensionsAndUnfitTypesAreRefused) {
  const Image image = random_image(2, 2, 1);
  EXPECT_EQ(message_of([&] { write_image("a.txt", image); }),
            "a.txt: the extension must be .png, .jpg, .tif or .exr");
  EXPECT_THROW(write_image(folder_ / "a.png", image, {SampleType::float32}), std::invalid_argument);
  EXPECT_THROW(write_image(folder_ / "a.jpg", image, {SampleType::uint16}), std::invalid_argument);
  EXPECT_THROW(write_image(folder_ / "a.png", Image()), std::invalid_argument);
  EXPECT_EQ(folder_.count(), 0u);
}

TEST_F(ImageFile, FilesThatAreNoPicturesAreRefused) {
  const fs::path path = folder_ / "a.png";
  std::ofstream(path) << "no picture";
  EXPECT_THROW(read_image(path), std::runtime_error);
  const std::string message = message_of([&] { read_image(folder_ / "none.png"); });
  EXPECT_NE(message.find((folder_ / "none.png").string()), std::string::npos) << message;
}

}  // namespace
}  // namespace solidnoise::image_file_test

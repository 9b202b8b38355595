#include <array>
#include <cstdint>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "solidnoise/core/random.h"
#include "solidnoise/image/image_file.h"
#include "solidnoise/image/image_module.h"
#include "support/message_of.h"
#include "support/temporary_folder.h"

namespace solidnoise::untrusted_picture_test {
namespace {

constexpr char kFormats[] = "it must be a PNG, JPEG, TIFF, OpenEXR or Radiance HDR file";

void append(std::string& bytes, std::uint32_t value, int count) {
  for (int i = 0; i < count; ++i) bytes += static_cast<char>(value >> (8 * i));
}

// A DirectDraw surface of 32-bit pixels with a depth.
std::string volumetric_dds(std::uint32_t side) {
  std::string bytes = "DDS ";
  const std::array<std::uint32_t, 31> header{
      124,  0x80100f, side,     side,       4 * side, side,     1, 0,  0,    0, 0,
      0,    0,        0,        0,          0,        0,        0, 32, 0x41, 0, 32,
      0xff, 0xff00,   0xff0000, 0xff000000, 0x401008, 0x200000, 0, 0,  0};
  for (const std::uint32_t word : header) append(bytes, word, 4);
  return bytes + std::string(4 * side * side * side, 'x');
}

// The description of 8-bit grey pixels in a TIFF, in one tile, which comes after it; `depth` is the number of
// slices.
std::string grey_tiff(std::uint32_t width, std::uint32_t height) {
  const std::vector<std::array<std::uint32_t, 3>> entries{{256, 4, width},   // ImageWidth
                                                          {257, 4, height},  // ImageLength
                                                          {258, 3, 8},       // BitsPerSample
                                                          {259, 3, 1},       // Compression: none
                                                          {262, 3, 1},       // black is zero
                                                          {322, 4, width},   // TileWidth
                                                          {323, 4, height},  // TileLength
                                                          {324, 4, 134},     // where the tile begins
                                                          {325, 4, width * height}};
  std::string bytes("II*\0", 4);
  append(bytes, 8, 4);
  append(bytes, static_cast<std::uint32_t>(entries.size()), 2);
  for (const auto& [tag, type, value] : entries) {
    append(bytes, tag, 2);
    append(bytes, type, 2);
    append(bytes, 1, 4);
    append(bytes, value, 4);
  }
  append(bytes, 0, 4);
  return bytes + std::string(134 - bytes.size(), '\0');
}

// Files as anybody could send them.
class UntrustedPicture : public testing::Test {
 protected:
  std::string complaint(const std::string& name) const {
    return message_of<std::runtime_error>([&] { read_image(folder_ / name); });
  }
  std::string refusal(const std::string& name, const std::string& reason) const {
    return "cannot read " + folder_.file(name) + ": " + reason;
  }

  TemporaryFolder folder_;
};

TEST_F(UntrustedPicture, IsReadByItsContentWhateverItsName) {
  write_image(folder_ / "a.jpg", Image(8, 6, 3));
  std::filesystem::rename(folder_ / "a.jpg", folder_ / "a.png");
  EXPECT_EQ(read_image(folder_ / "a.png").width, 8);

  folder_.write("a.tif", grey_tiff(16, 16) + std::string(256, '\x7f'));
  EXPECT_NEAR(read_image(folder_ / "a.tif").at(3, 3), 127.0f / 255.0f, 1e-6f);
}

TEST_F(UntrustedPicture, OfAnotherFormatIsRefused) {
  folder_.write("a.png", volumetric_dds(16));
  folder_.write("a.ppm", "P6 2 2 255 123412341234");
  folder_.write("empty.png", "");
  for (const std::string name : {"a.png", "a.ppm", "empty.png"})
    EXPECT_EQ(complaint(name), refusal(name, kFormats));
  std::filesystem::create_directory(folder_ / "folder.png");
  EXPECT_EQ(complaint("folder.png"), folder_.file("folder.png") + ": is a folder, not a file");
}

// OpenImageIO has a format whose files need not exist.
TEST_F(UntrustedPicture, MustBeAFile) {
  const std::string name = "x.null?RES=64x64x64&CHANNELS=1";
  EXPECT_EQ(complaint(name), folder_.file(name) + ": cannot be read: No such file or directory");
}

// None of the formats that are read has depth in OpenImageIO 2.4; the room that is asked for counts it all
// the same.
TEST_F(UntrustedPicture, IsGivenRoomForItsDepth) {
  const std::string bytes = volumetric_dds(16);
  const auto refuse = [](void* context, int, int, int depth, int) -> float* {
    *static_cast<int*>(context) = depth;
    return nullptr;
  };
  int depth = 0;
  std::array<char, 100> text{};
  SolidnoiseImageError error{text.data(), text.size()};
  EXPECT_NE(image_module().decode("dds", bytes.data(), bytes.size(), refuse, nullptr, &depth, &error), 0);
  EXPECT_EQ(depth, 16) << text.data();
}

TEST_F(UntrustedPicture, ThatClaimsTooManyPixelsIsRefusedBeforeMemoryIsTaken) {
  folder_.write("a.tif", grey_tiff(60000, 60000));
  EXPECT_EQ(complaint("a.tif"),
            refusal("a.tif",
                    "it has 60000 x 60000 pixels of 1 channels; width x height x channels must be "
                    "at most 268435456"));
}

// An OpenEXR file that begins with an attribute.
std::string exr_with(const TemporaryFolder& folder, const std::string& name, const std::string& type,
                     std::uint32_t size, const std::string& value) {
  constexpr std::size_t kHeader = 8;  // where the attributes begin
  write_image(folder / "whole.exr", Image(64, 64, 3), {.existing = Existing::replace});
  const std::string whole = folder.read("whole.exr");
  std::string attribute = name + '\0' + type + '\0';
  append(attribute, size, 4);
  return whole.substr(0, kHeader) + attribute + value + whole.substr(kHeader);
}

// Its attribute of this name, with another value.
std::string exr_changed(const TemporaryFolder& folder, const std::string& attribute,
                        const std::string& value) {
  write_image(folder / "whole.exr", Image(64, 64, 3), {.existing = Existing::replace});
  std::string bytes = folder.read("whole.exr");
  const std::size_t type = bytes.find(attribute + '\0') + attribute.size() + 1;
  constexpr std::size_t kSize = 4;
  return bytes.replace(bytes.find('\0', type) + 1 + kSize, value.size(), value);
}

TEST_F(UntrustedPicture, OfOpenExrIsRefusedForAnAttributeLongerThanTheFile) {
  const std::string bytes = exr_with(folder_, "note", "string", 0x65000000, "x");
  folder_.write("a.exr", bytes);
  EXPECT_EQ(complaint("a.exr"),
            refusal("a.exr", "its attribute note claims 1694498816 bytes of the " +
                                 std::to_string(bytes.size() - 8 - 16) + " that are left"));
  std::string preview;
  for (const std::uint32_t number : {30000, 30000}) append(preview, number, 4);
  folder_.write("a.exr", exr_with(folder_, "preview", "preview", 8, preview));
  EXPECT_EQ(complaint("a.exr"), refusal("a.exr", "its preview has not the size it says, in 8 bytes"));
}

TEST_F(UntrustedPicture, OfOpenExrIsRefusedForATableLongerThanTheFile) {
  std::string tall;
  for (const std::uint32_t corner : {0, 0, 0, 200000000}) append(tall, corner, 4);
  const std::string bytes = exr_changed(folder_, "dataWindow", tall);
  folder_.write("a.exr", bytes);
  EXPECT_EQ(complaint("a.exr"),
            refusal("a.exr", "it has 1 x 200000001 pixels; a side must have at most 1048576"));
  tall.clear();
  for (const std::uint32_t corner : {0, 0, 0, 999999}) append(tall, corner, 4);
  folder_.write("a.exr", exr_changed(folder_, "dataWindow", tall));
  EXPECT_EQ(complaint("a.exr"), refusal("a.exr", "its 62500 blocks of pixels cannot be in " +
                                                     std::to_string(bytes.size()) + " bytes"));
}

// The tile's 2^30 pixels would be held in 5 GB.
TEST_F(UntrustedPicture, WithTilesLargerThanAnyPictureIsRefused) {
  std::string tiff = grey_tiff(16, 16);
  constexpr std::size_t kTiles = 2 + 8 + 5 * 12 + 8;  // where the tile's width is
  std::string side;
  append(side, 32768, 4);
  tiff.replace(kTiles, 4, side);
  tiff.replace(kTiles + 12, 4, side);
  folder_.write("a.tif", tiff + std::string(256, 'x'));
  EXPECT_EQ(complaint("a.tif"), refusal("a.tif", "its tiles are 32768 x 32768 pixels; they must be smaller"));
}

// A TIFF of 16 x 16 pixels in which the entry of the picture's colours is another one.
std::string tiff_with(std::uint32_t tag, std::uint32_t type, std::uint32_t value) {
  std::string entry;
  append(entry, tag, 2);
  append(entry, type, 2);
  append(entry, 1, 4);
  append(entry, value, 4);
  constexpr std::size_t kColours = 2 + 8 + 4 * 12;
  return grey_tiff(16, 16).replace(kColours, entry.size(), entry) + std::string(256, 'x');
}

// The reader would abort, allocate gigabytes or run for ever.
TEST_F(UntrustedPicture, OfTiffWithADepthIsRefused) {
  const auto complaint_of = [&](std::uint32_t tag, std::uint32_t type, std::uint32_t value) {
    folder_.write("a.tif", tiff_with(tag, type, value));
    return complaint("a.tif");
  };
  EXPECT_EQ(complaint_of(32998, 4, 0x80000000),
            refusal("a.tif", "its TileDepth is 2147483648; it must be 1"));
  EXPECT_EQ(complaint_of(32998, 4, 0xffffffff),
            refusal("a.tif", "its TileDepth is 4294967295; it must be 1"));
  EXPECT_EQ(complaint_of(32998, 3, 0), refusal("a.tif", "its TileDepth is 0; it must be 1"));
  EXPECT_EQ(complaint_of(32997, 3, 2), refusal("a.tif", "its ImageDepth is 2; it must be 1"));
  EXPECT_EQ(complaint_of(32998, 16, 1),
            refusal("a.tif", "its TileDepth is 1 values of type 16; it must be one of type 3 or 4"));
  folder_.write("a.tif", std::string("MM\0*\0\0\0\x08\0\x01\x80\xe6\0\x04\0\0\0\x01\xff\0\0\0", 22));
  EXPECT_EQ(complaint("a.tif"), refusal("a.tif", "its TileDepth is 4278190080; it must be 1"));
  folder_.write("a.tif", std::string("II*\0\xff\xff\xff\xff", 8));
  EXPECT_EQ(complaint("a.tif"), refusal("a.tif", "it is cut short"));
}

TEST_F(UntrustedPicture, ThatIsAProgressiveJpegOfTooManyPixelsIsRefusedBeforeMemoryIsTaken) {
  // A frame of 65500 x 65500 pixels of 3 channels, of which a decoder would hold 25 GB.
  const std::string frame("\xff\xd8\xff\xc2\0\x11\x08\xff\xdc\xff\xdc\x03\x01\x11\0\x02\x11\0\x03\x11\0", 21);
  folder_.write("a.jpg", frame + std::string("\xff\xda\0\x0c\x03\x01\0\x02\0\x03\0\0\x3f\0", 14));
  EXPECT_EQ(complaint("a.jpg"),
            refusal("a.jpg",
                    "it has 65500 x 65500 pixels of 3 channels; width x height x channels must be at "
                    "most 268435456"));
}

TEST_F(UntrustedPicture, CutAtHalfIsRefused) {
  Image image(64, 64, 3);
  RandomStream stream(7);
  for (float& value : image.pixels) value = static_cast<float>(stream.next_unit());
  testing::internal::CaptureStderr();
  for (const std::string name : {"a.png", "a.jpg", "a.tif", "a.exr"}) {
    SCOPED_TRACE(name);
    write_image(folder_ / name, image);
    const std::string whole = folder_.read(name);
    folder_.write(name, whole.substr(0, whole.size() / 2));
    const std::string message = complaint(name);
    EXPECT_TRUE(message.starts_with("cannot read " + folder_.file(name) + ": ")) << message;
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
  }
  // Those of 1 and 3 bits, in the middle of what is compressed, are told by libpng alone.
  write_image(folder_ / "c.png", image);
  const std::string png = folder_.read("c.png");
  for (const std::size_t place : {20ul, png.size() / 2, png.size() / 2 + 1, png.size() - 20}) {
    std::string damaged = png;
    damaged[place] ^= 5;
    folder_.write("c.png", damaged);
    const std::string message = complaint("c.png");
    EXPECT_TRUE(message.starts_with("cannot read ")) << message;
  }
  // Here the description comes before the pixels, not after them.
  folder_.write("b.tif", grey_tiff(64, 64) + std::string(64 * 32, 'x'));
  EXPECT_TRUE(complaint("b.tif").starts_with("cannot read ")) << complaint("b.tif");
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

}  // namespace
}  // namespace solidnoise::untrusted_picture_test

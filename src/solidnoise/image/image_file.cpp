#include "solidnoise/image/image_file.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cerrno>
#include <cstdint>
#include <fstream>
#include <new>
#include <stdexcept>
#include <string>
#include <string_view>
#include <system_error>
#include <unistd.h>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "solidnoise/image/image_module.h"

namespace solidnoise {
namespace {

namespace fs = std::filesystem;

struct Format {
  std::string_view extension;
  SampleType automatic;
  std::vector<SampleType> types;
};

const std::vector<Format>& formats() {
  using enum SampleType;
  static const std::vector<Format> all{
      {".png", uint8, {uint8, uint16}},
      {".jpg", uint8, {uint8}},
      {".jpeg", uint8, {uint8}},
      {".tif", uint16, {uint8, uint16, float32}},
      {".tiff", uint16, {uint8, uint16, float32}},
      {".exr", float32, {float16, float32}},
  };
  return all;
}

int module_type(SampleType type) {
  switch (type) {
    case SampleType::uint8:
      return kSolidnoiseImageUint8;
    case SampleType::uint16:
      return kSolidnoiseImageUint16;
    case SampleType::float16:
      return kSolidnoiseImageHalf;
    default:
      return kSolidnoiseImageFloat;
  }
}

std::string lower_extension(const fs::path& path) {
  std::string extension = path.extension().string();
  for (char& c : extension) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return extension;
}

SampleType choose_type(const fs::path& path, SampleType wanted) {
  const std::string extension = lower_extension(path);
  for (const Format& format : formats()) {
    if (format.extension != extension) continue;
    if (wanted == SampleType::automatic) return format.automatic;
    if (std::find(format.types.begin(), format.types.end(), wanted) == format.types.end()) {
      throw std::invalid_argument(
          fmt::format("{}: this sample type cannot be stored in a {} file", path.string(), extension));
    }
    return wanted;
  }
  throw std::invalid_argument(
      fmt::format("{}: the extension must be .png, .jpg, .tif or .exr", path.string()));
}

void require_complete(const fs::path& path, const Image& image) {
  const bool complete = image.width > 0 && image.height > 0 && image.channels > 0 &&
                        image.pixels.size() == Image(image.width, image.height, image.channels).pixels.size();
  if (!complete) {
    throw std::invalid_argument(fmt::format("{}: the picture of {} x {} with {} channels has {} values",
                                            path.string(), image.width, image.height, image.channels,
                                            image.pixels.size()));
  }
}

// Removes the file unless it was renamed before.
class TemporaryFile {
 public:
  explicit TemporaryFile(const fs::path& target)
      : path_(target.parent_path() /
              fmt::format(".{}.{}{}", target.stem().string(), ::getpid(), target.extension().string())) {}
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;
  ~TemporaryFile() {
    std::error_code ignored;
    fs::remove(path_, ignored);
  }

  const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

// What OpenImageIO says, on one line, about the file the user knows instead of the temporary one.
std::string explain(std::string message, const std::string& temporary, const std::string& path) {
  for (std::size_t at = message.find(temporary); at != std::string::npos; at = message.find(temporary, at)) {
    message.replace(at, temporary.size(), path);
    at += path.size();
  }
  while (!message.empty() && std::isspace(static_cast<unsigned char>(message.back()))) message.pop_back();
  std::replace(message.begin(), message.end(), '\n', ' ');
  return message.empty() ? "unknown error" : message;
}

// A kind of file that is read: the bytes it begins with, and OpenImageIO's name for it.
struct Signature {
  std::string_view bytes;
  std::string_view format;
};

constexpr std::array kSignatures{Signature{{"\x89PNG\r\n\x1a\n", 8}, "png"},
                                 Signature{{"\xff\xd8\xff", 3}, "jpeg"},
                                 Signature{{"II*\0", 4}, "tiff"},
                                 Signature{{"MM\0*", 4}, "tiff"},
                                 Signature{{"\x76\x2f\x31\x01", 4}, "openexr"},
                                 Signature{{"#?RADIANCE", 10}, "hdr"},
                                 Signature{{"#?RGBE", 6}, "hdr"}};

// OpenImageIO, left to itself, would try all of its formats on a file: each is one more parser for hostile
// bytes, and some run for other things than pictures.
std::string_view format_of(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::array<char, 10> begin{};
  file.read(begin.data(), begin.size());
  if (!file.is_open() || file.bad()) throw std::runtime_error(std::generic_category().message(errno));
  const std::string_view bytes(begin.data(), static_cast<std::size_t>(file.gcount()));
  for (const Signature& signature : kSignatures) {
    if (bytes.starts_with(signature.bytes)) return signature.format;
  }
  throw std::runtime_error("it must be a PNG, JPEG, TIFF, OpenEXR or Radiance HDR file");
}

// Whether a PNG file goes on up to its closing chunk. libpng prints a line of its own about a file without
// it.
bool is_whole_png(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  file.seekg(8);
  std::array<unsigned char, 8> head{};
  while (file.read(reinterpret_cast<char*>(head.data()), head.size())) {
    const std::string_view type(reinterpret_cast<const char*>(head.data()) + 4, 4);
    if (type == "IEND") return static_cast<bool>(file.ignore(4)) && file.gcount() == 4;
    const std::uint32_t length = head[0] * 0x1000000u + head[1] * 0x10000u + head[2] * 0x100u + head[3];
    file.seekg(std::int64_t{length} + 4, std::ios::cur);
  }
  return false;
}

constexpr std::size_t kMostValues = std::size_t{1} << 28;  // a gigabyte of floats

// A picture that is being read, and why it is refused.
struct Reading {
  Image image;
  std::size_t most_values = kMostValues;
  std::string refusal;
};

float* allocate_image(void* context, int width, int height, int depth, int channels) {
  Reading& reading = *static_cast<Reading*>(context);
  try {
    if (depth > 1) {
      reading.refusal = fmt::format("it is {} pixels deep; a picture must be 1 deep", depth);
      return nullptr;
    }
    const double values = static_cast<double>(width) * height * channels;
    if (width < 1 || height < 1 || channels < 1 || values > static_cast<double>(reading.most_values)) {
      reading.refusal =
          fmt::format("it has {} x {} pixels of {} channels; width x height x channels must be at most {}",
                      width, height, channels, reading.most_values);
      return nullptr;
    }
    reading.image = Image(width, height, channels);
    return reading.image.pixels.data();
  } catch (const std::bad_alloc&) {
    return nullptr;
  }
}

// Throws std::runtime_error that says what is wrong, but not with which file.
Image read(const fs::path& path, std::size_t most_values) {
  const std::string_view format = format_of(path);
  if (format == "png" && !is_whole_png(path)) throw std::runtime_error("it is cut short");
  Reading reading;
  reading.most_values = most_values;
  std::array<char, 1024> text{};
  SolidnoiseImageError error{text.data(), text.size()};
  if (image_module().read(path.c_str(), format.data(), allocate_image, &reading, &error) != 0) {
    throw std::runtime_error(reading.refusal.empty() ? text.data() : reading.refusal);
  }
  return std::move(reading.image);
}

// Whether the file that was just written holds a picture of that size. OpenImageIO's PNG writer says nothing
// when the disk is full.
bool is_whole(const fs::path& path, const Image& image) {
  try {
    const Image stored = read(path, image.pixels.size());
    return stored.width == image.width && stored.height == image.height;
  } catch (const std::runtime_error&) {
    return false;
  }
}

}  // namespace

void write_image(const fs::path& path, const Image& image, const ImageFileOptions& options) {
  const SampleType type = choose_type(path, options.sample_type);
  require_complete(path, image);
  const ImageModule& module = image_module();

  const TemporaryFile temporary(path);
  std::array<char, 1024> text{};
  SolidnoiseImageError error{text.data(), text.size()};
  const SolidnoiseImagePicture picture{image.width, image.height, image.channels, image.pixels.data()};
  const char* const color_space = options.color_space == ColorSpace::srgb ? "sRGB" : "Linear";
  if (module.write(temporary.path().c_str(), &picture, module_type(type), color_space, &error) != 0) {
    throw std::runtime_error(fmt::format("cannot write {}: {}", path.string(),
                                         explain(text.data(), temporary.path().string(), path.string())));
  }

  if (!is_whole(temporary.path(), image)) {
    throw std::runtime_error(
        fmt::format("cannot write {}: the file is damaged after writing; is the disk full?", path.string()));
  }
  std::error_code failure;
  fs::rename(temporary.path(), path, failure);
  if (failure) throw std::runtime_error(fmt::format("cannot write {}: {}", path.string(), failure.message()));
}

Image read_image(const fs::path& path) {
  try {
    return read(path, kMostValues);
  } catch (const std::runtime_error& error) {
    throw std::runtime_error(fmt::format("cannot read {}: {}", path.string(),
                                         explain(error.what(), path.string(), path.string())));
  }
}

}  // namespace solidnoise

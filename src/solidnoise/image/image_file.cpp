#include "solidnoise/image/image_file.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <fstream>
#include <new>
#include <stdexcept>
#include <string>
#include <string_view>
#include <system_error>
#include <unistd.h>
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

// What OpenImageIO says, about the file the user knows instead of the temporary one.
std::string explain(std::string message, const std::string& temporary, const std::string& path) {
  for (std::size_t at = message.find(temporary); at != std::string::npos; at = message.find(temporary, at)) {
    message.replace(at, temporary.size(), path);
    at += path.size();
  }
  while (!message.empty() && std::isspace(static_cast<unsigned char>(message.back()))) message.pop_back();
  std::replace(message.begin(), message.end(), '\n', ' ');
  return message.empty() ? "unknown error" : message;
}

float* allocate_image(void* context, int width, int height, int channels) {
  try {
    Image& image = *static_cast<Image*>(context);
    image = Image(width, height, channels);
    return image.pixels.data();
  } catch (const std::bad_alloc&) {
    return nullptr;
  }
}

// Returns an empty text or what went wrong.
std::string try_read(const fs::path& path, Image& image) {
  std::array<char, 1024> text{};
  SolidnoiseImageError error{text.data(), text.size()};
  if (image_module().read(path.c_str(), allocate_image, &image, &error) == 0) return {};
  return text[0] == '\0' ? "unknown error" : text.data();
}

// Whether a .png file has its closing chunk. libpng prints a line of its own about a file without it.
bool is_whole_png(const fs::path& path) {
  constexpr std::string_view kEnd("\0\0\0\0IEND\xae\x42\x60\x82", 12);
  std::ifstream file(path, std::ios::binary);
  file.seekg(-static_cast<std::streamoff>(kEnd.size()), std::ios::end);
  std::array<char, kEnd.size()> end{};
  file.read(end.data(), end.size());
  return file && std::string_view(end.data(), end.size()) == kEnd;
}

// Whether the file that was just written holds a picture of that size. OpenImageIO's PNG writer says nothing
// when the disk is full.
bool is_whole(const fs::path& path, const Image& image) {
  if (lower_extension(path) == ".png" && !is_whole_png(path)) return false;
  Image stored;
  return try_read(path, stored).empty() && stored.width == image.width && stored.height == image.height;
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
  Image image;
  const std::string complaint = try_read(path, image);
  if (!complaint.empty()) {
    throw std::runtime_error(
        fmt::format("cannot read {}: {}", path.string(), explain(complaint, path.string(), path.string())));
  }
  return image;
}

}  // namespace solidnoise

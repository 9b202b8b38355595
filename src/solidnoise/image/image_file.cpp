#include "solidnoise/image/image_file.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdint>
#include <new>
#include <ostream>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "solidnoise/core/extension.h"
#include "solidnoise/core/input_file.h"
#include "solidnoise/image/check_picture.h"
#include "solidnoise/image/image_module.h"

namespace solidnoise {
namespace {

namespace fs = std::filesystem;

struct Format {
  std::string_view extension;
  const char* name;  // OpenImageIO's
  SampleType automatic;
  std::vector<SampleType> types;
};

const std::vector<Format>& formats() {
  using enum SampleType;
  static const std::vector<Format> all{
      {".png", "png", uint8, {uint8, uint16}},
      {".jpg", "jpeg", uint8, {uint8}},
      {".jpeg", "jpeg", uint8, {uint8}},
      {".tif", "tiff", uint16, {uint8, uint16, float32}},
      {".tiff", "tiff", uint16, {uint8, uint16, float32}},
      {".exr", "openexr", float32, {float16, float32}},
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

const Format& format_to_write(const fs::path& path) {
  const std::string extension = extension_of(path);
  for (const Format& format : formats()) {
    if (format.extension == extension) return format;
  }
  throw std::invalid_argument(
      fmt::format("{}: the extension must be .png, .jpg, .tif or .exr", path.string()));
}

SampleType choose_type(const fs::path& path, const Format& format, SampleType wanted) {
  if (wanted == SampleType::automatic) return format.automatic;
  if (std::find(format.types.begin(), format.types.end(), wanted) != format.types.end()) return wanted;
  throw std::invalid_argument(
      fmt::format("{}: this sample type cannot be stored in a {} file", path.string(), format.extension));
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

// What OpenImageIO says, on one line.
std::string explain(std::string message) {
  while (!message.empty() && std::isspace(static_cast<unsigned char>(message.back()))) message.pop_back();
  std::replace(message.begin(), message.end(), '\n', ' ');
  return message.empty() ? "unknown error" : message;
}

// A kind of file that is read: the bytes it begins with, and OpenImageIO's name for it.
struct Signature {
  std::string_view bytes;
  const char* format;
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
const char* format_of(std::string_view bytes) {
  for (const Signature& signature : kSignatures) {
    if (bytes.starts_with(signature.bytes)) return signature.format;
  }
  throw std::runtime_error("it must be a PNG, JPEG, TIFF, OpenEXR or Radiance HDR file");
}

constexpr std::uint64_t kMostBytes = std::uint64_t{1} << 30;

// A picture that is being read, and why it is refused.
struct Reading {
  Progress* progress;
  const BeforePixels& before;
  bool stopped = false;
  Image image{};
  std::string refusal{};
};

// The bytes of a picture that is being written.
struct Writing {
  Progress* progress;
  bool stopped = false;
  std::string bytes{};
};

template <typename Work>
bool told(void* context, float done) {
  constexpr std::uint64_t kUnits = 1'000'000;
  Work& work = *static_cast<Work*>(context);
  if (work.progress == nullptr) return false;
  work.progress->advance(static_cast<std::uint64_t>(static_cast<double>(done) * kUnits), kUnits);
  return work.stopped = work.progress->cancelled();
}

float* allocate_image(void* context, int width, int height, int depth, int channels) {
  Reading& reading = *static_cast<Reading*>(context);
  try {
    if (depth > 1)
      throw std::runtime_error(fmt::format("it is {} pixels deep; a picture must be 1 deep", depth));
    require_picture_size(width, height, channels);
    if (reading.before) {
      reading.before(sizeof(float) * static_cast<std::uint64_t>(width) * static_cast<std::uint64_t>(height) *
                     static_cast<std::uint64_t>(channels));
    }
    reading.image = Image(width, height, channels);
    return reading.image.pixels.data();
  } catch (const std::bad_alloc&) {
    return nullptr;
  } catch (const std::runtime_error& error) {
    reading.refusal = error.what();
    return nullptr;
  }
}

// Throws std::runtime_error that says what is wrong, but not with which file.
Image decode(std::string_view bytes, Progress* progress, const BeforePixels& before) {
  const char* const format = format_of(bytes);
  check_picture(format, bytes);
  Reading reading{progress, before};
  std::array<char, 1024> text{};
  SolidnoiseImageError error{text.data(), text.size()};
  const int status = image_module().decode(format, bytes.data(), bytes.size(), allocate_image, told<Reading>,
                                           &reading, &error);
  if (reading.stopped) throw Cancelled();
  if (status != 0) {
    throw std::runtime_error(reading.refusal.empty() ? text.data() : reading.refusal);
  }
  return std::move(reading.image);
}

}  // namespace

void write_image(const fs::path& path, const Image& image, const ImageFileOptions& options) {
  const Format& format = format_to_write(path);
  const SampleType type = choose_type(path, format, options.sample_type);
  require_complete(path, image);
  const ImageModule& module = image_module();
  write_output(
      path, {.existing = options.existing, .progress = options.progress, .group = options.group},
      [&](std::ostream& stream) {
        const auto take = [](void* context, const char* bytes, std::size_t count) {
          static_cast<Writing*>(context)->bytes.assign(bytes, count);
        };
        Writing writing{options.progress};
        std::array<char, 1024> text{};
        SolidnoiseImageError error{text.data(), text.size()};
        const SolidnoiseImagePicture picture{image.width, image.height, image.channels, image.pixels.data()};
        const char* const color_space = options.color_space == ColorSpace::srgb ? "sRGB" : "Linear";
        const int status = module.encode(format.name, &picture, module_type(type), color_space, take,
                                         told<Writing>, &writing, &error);
        if (writing.stopped) throw Cancelled();
        if (status != 0) {
          throw std::runtime_error(fmt::format("cannot write {}: {}", path.string(), explain(text.data())));
        }
        stream << writing.bytes;
      });
}

Image read_image(const fs::path& path, Progress* progress, const BeforePixels& before) {
  return read_image(read_file(path, kMostBytes), path.string(), progress, before);
}

Image read_image(std::string_view bytes, const std::string& name, Progress* progress,
                 const BeforePixels& before) {
  try {
    return decode(bytes, progress, before);
  } catch (const Cancelled&) {
    throw;
  } catch (const std::runtime_error& error) {
    throw std::runtime_error(fmt::format("cannot read {}: {}", name, explain(error.what())));
  }
}

}  // namespace solidnoise

#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>

#include "solidnoise/core/image.h"
#include "solidnoise/core/output_file.h"
#include "solidnoise/core/progress.h"

namespace solidnoise {

// How one channel of one pixel is stored. `automatic`: 8 bits for .png and .jpg, 16 for .tif, 32-bit float
// for .exr.
enum class SampleType { automatic, uint8, uint16, float16, float32 };

// What the pixels are, written into the file as a tag. Pixels are stored as they are: encode them first.
// Plain data (heights, masks) is `linear`.
enum class ColorSpace { srgb, linear };

struct ImageFileOptions {
  SampleType sample_type = SampleType::automatic;
  ColorSpace color_space = ColorSpace::srgb;
  Existing existing = Existing::refuse;
  OutputGroup* group = nullptr;  // with which the file appears
  Progress* progress = nullptr;
};

// Writes a .png (8 or 16 bits), .jpg (8), .tif (8, 16, float32) or .exr (float16, float32) file, by the
// extension, all or nothing, as write_output does. Integer types clamp to [0, 1]. Throws
// std::invalid_argument if the extension, the type or the picture is at fault; std::runtime_error if the
// image module is not installed, OutputExists, what else write_output throws, and Cancelled where `progress`
// asks to stop, which is asked some times a second.
//
// OpenImageIO, which does the work, is loaded by the first call of either function: linking this library
// costs nothing at start. The module is looked for at $SOLIDNOISE_IMAGE_MODULE, relative to the program or
// library that contains this function, where it is installed, and where the dynamic linker looks.
void write_image(const std::filesystem::path& path, const Image& image, const ImageFileOptions& options = {});

// Reads a PNG, JPEG, TIFF, OpenEXR or Radiance HDR file, told by what it begins with, whatever its name:
// first image, all channels, integers scaled to [0, 1], pixels as they are stored. Files may come from
// anybody: a damaged one, one with depth, with a side of more than 2^20 pixels or of more than 2^28
// values (width x height x channels) is refused, by std::runtime_error that names the path. Throws Cancelled
// where `progress` asks to stop. `before` is told how many bytes the pixels will take, before they do, and
// may refuse by std::runtime_error.
using BeforePixels = std::function<void(std::uint64_t bytes)>;
Image read_image(const std::filesystem::path& path, Progress* progress = nullptr,
                 const BeforePixels& before = {});

// The same from a file's bytes; `name` stands for the path in messages.
Image read_image(std::string_view bytes, const std::string& name, Progress* progress = nullptr,
                 const BeforePixels& before = {});

}  // namespace solidnoise

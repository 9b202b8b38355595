#pragma once

#include "solidnoise/image/module/image_io.h"

namespace solidnoise {

struct ImageModule {
  SolidnoiseImageEncode* encode = nullptr;
  SolidnoiseImageDecode* decode = nullptr;
  SolidnoiseImageDraw* draw = nullptr;
};

// The module that links OpenImageIO, loaded by the first call that succeeds and kept until the process ends.
// Throws std::runtime_error if it is not found or does not fit, naming the file.
const ImageModule& image_module();

}  // namespace solidnoise

#include "solidnoise/image/image_file.h"

// A shared library of somebody who uses ours, and its program: picture_program.cpp.
extern "C" int write_a_picture(const char* path) {
  try {
    solidnoise::write_image(path, solidnoise::Image(2, 2, 3));
    return 0;
  } catch (const std::runtime_error&) {
    return 1;
  }
}

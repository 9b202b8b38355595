#pragma once

// tinygltf as we use it: buffers and the text, no images, no files but by our own functions. What is defined
// here is so where the library is compiled, too (gltf_library.cpp).
#define TINYGLTF_NO_EXTERNAL_IMAGE
#define TINYGLTF_NO_FS
#define TINYGLTF_NO_STB_IMAGE
#define TINYGLTF_NO_STB_IMAGE_WRITE
#define TINYGLTF_NO_INCLUDE_STB_IMAGE
#define TINYGLTF_NO_INCLUDE_STB_IMAGE_WRITE

#include <fstream>
#include <tiny_gltf.h>

#define TINYGLTF_IMPLEMENTATION
#include "solidnoise/geometry/gltf_library.h"

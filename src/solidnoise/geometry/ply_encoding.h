#pragma once

namespace solidnoise {

// How a PLY file stores what follows its header.
enum class PlyEncoding { ascii, binary_little_endian, binary_big_endian };

}  // namespace solidnoise

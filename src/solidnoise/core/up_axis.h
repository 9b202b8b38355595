#pragma once

namespace solidnoise {

// Which way is up.
enum class UpAxis { y, z };

}  // namespace solidnoise

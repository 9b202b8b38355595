#pragma once

#include <cstdint>
#include <string>

namespace solidnoise {

// "1.5 GiB".
std::string format_bytes(std::uint64_t bytes);

}  // namespace solidnoise

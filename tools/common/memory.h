#pragma once

#include <cstdint>

namespace solidnoise {

// Memory that programs can still take without swapping, in bytes: the machine's, or what is left of the
// control group's where that is less. 0 if the system does not say.
std::uint64_t available_memory();

}  // namespace solidnoise

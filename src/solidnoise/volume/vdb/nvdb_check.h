#pragma once

#include <cstdint>
#include <span>

namespace solidnoise {

// Throws std::runtime_error unless the bytes are a NanoVDB grid of this type of values (nanovdb's: float,
// Fp16, Fp8, Fp4, Vec3f) in which each node is where it may be, with its checksum where it has one: NanoVDB
// follows whatever offsets it finds. Aligned as NanoVDB's buffers are.
template <typename BuildType>
void check_nvdb_grid(std::span<const std::uint8_t> bytes);

}  // namespace solidnoise

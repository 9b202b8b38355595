#pragma once

#include <stdexcept>
#include <string>

namespace solidnoise {

// Runs `run`; what it refuses (std::invalid_argument) becomes an error of a file (std::runtime_error).
template <typename Run>
auto as_file_error(const Run& run) {
  try {
    return run();
  } catch (const std::invalid_argument& error) {
    throw std::runtime_error(error.what());
  }
}

// The same with the file's name before it: "rock.ply: the mesh has a border".
template <typename Run>
auto in_file(const std::string& file, const Run& run) {
  try {
    return run();
  } catch (const std::invalid_argument& error) {
    throw std::runtime_error(file + ": " + error.what());
  }
}

// Runs `run`; what it refuses is of the field at this path, which goes right before it: "cloud." and "dim is
// 0".
template <typename Run>
auto in_field(const std::string& path, const Run& run) {
  try {
    return run();
  } catch (const std::invalid_argument& error) {
    throw std::invalid_argument(path + error.what());
  }
}

}  // namespace solidnoise

#pragma once

#include <stdexcept>

namespace solidnoise {

// Runs `action`; what it refuses becomes an error of the file.
template <typename Action>
auto as_file_error(const Action& action) {
  try {
    return action();
  } catch (const std::invalid_argument& error) {
    throw std::runtime_error(error.what());
  }
}

}  // namespace solidnoise

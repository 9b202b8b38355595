#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <stdexcept>
#include <string_view>

#include "solidnoise/image/image_file.h"

// Whatever can be read as a picture has as many values as it says.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace solidnoise;
  try {
    const Image image = read_image({reinterpret_cast<const char*>(data), size}, "picture");
    const auto values = static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height) *
                        static_cast<std::size_t>(image.channels);
    if (image.pixels.size() != values) std::abort();
  } catch (const std::runtime_error& error) {
    if (!std::string_view(error.what()).starts_with("cannot read picture: ")) std::abort();
  }
  return 0;
}

#include <cstddef>
#include <stdexcept>
#include <string_view>

#include <fmt/format.h>

#include "solidnoise/image/byte_order.h"
#include "solidnoise/image/check_picture.h"

namespace solidnoise {
namespace {

enum Tag : std::size_t { kImageDepth = 32997, kTileDepth = 32998 };
enum Type : std::size_t { kShort = 3, kLong = 4 };

// Reads numbers in the order of bytes that the file begins with: II or MM.
class TiffCheck {
 public:
  explicit TiffCheck(std::string_view bytes) : bytes_(bytes), is_big_endian_(bytes.starts_with("MM")) {}

  // The entries of the first directory, which is that of the picture.
  void check() const {
    constexpr std::size_t kWhere = 4;
    constexpr std::size_t kEntry = 12;
    const std::size_t directory = number(kWhere, 4);
    const std::size_t count = number(directory, 2);
    for (std::size_t i = 0; i < count; ++i) check_entry(directory + 2 + i * kEntry);
  }

 private:
  std::size_t number(std::size_t place, std::size_t count) const {
    if (place + count > bytes_.size()) throw std::runtime_error("it is cut short");
    const std::string_view number = bytes_.substr(place, count);
    return is_big_endian_ ? big_endian(number) : little_endian(number);
  }

  // Of an entry: tag, type, how many values there are, and the value if it is one of at most 4 bytes.
  void check_entry(std::size_t place) const {
    const std::size_t tag = number(place, 2);
    const std::size_t type = number(place + 2, 2);
    const std::size_t count = number(place + 4, 4);
    const std::size_t value = number(place + 8, type == kShort ? 2 : 4);
    if (tag != kImageDepth && tag != kTileDepth) return;
    const char* const name = tag == kImageDepth ? "ImageDepth" : "TileDepth";
    if ((type != kShort && type != kLong) || count != 1) {
      throw std::runtime_error(
          fmt::format("its {} is {} values of type {}; it must be one of type 3 or 4", name, count, type));
    }
    if (value != 1) throw std::runtime_error(fmt::format("its {} is {}; it must be 1", name, value));
  }

  std::string_view bytes_;
  bool is_big_endian_;
};

}  // namespace

void check_tiff(std::string_view bytes) {
  TiffCheck(bytes).check();
}

}  // namespace solidnoise

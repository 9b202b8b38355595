#include <algorithm>
#include <cstdint>
#include <stdexcept>
#include <string>

#include <fmt/format.h>

#include "solidnoise/core/printable.h"
#include "solidnoise/image/byte_order.h"
#include "solidnoise/image/check_picture.h"

namespace solidnoise {
namespace {

constexpr std::uint32_t kDeep = 0x800;      // bits of the version
constexpr std::uint32_t kSeveral = 0x1000;  // parts
constexpr std::size_t kLongestName = 255;   // OpenEXR's own limit
constexpr std::size_t kBytesPerOffset = 8;  // of a block's place in the file
constexpr double kMostBlockValues = static_cast<double>(kMostPictureValues) / 4.0;

// What a part's header says of its size.
struct Part {
  double width = 0.0;
  double height = 0.0;
  double channels = 0.0;
  double tile_width = 0.0;  // 0: scan lines
  double tile_height = 0.0;
  double lines = 1.0;  // that are compressed together
};

class ExrCheck {
 public:
  explicit ExrCheck(std::string_view bytes) : bytes_(bytes), left_(bytes) {}

  void check() {
    take(4);  // the signature
    const auto version = static_cast<std::uint32_t>(number(take(4)));
    if ((version & kDeep) != 0) throw std::runtime_error("it is deep; a picture must be flat");
    do {
      check_part();
    } while ((version & kSeveral) != 0 && !ends());
  }

 private:
  std::string_view take(std::size_t count) {
    if (count > left_.size()) throw std::runtime_error("it is cut short");
    const std::string_view taken = left_.substr(0, count);
    left_.remove_prefix(count);
    return taken;
  }

  // A number of 1, 2 or 4 bytes.
  static std::int32_t number(std::string_view bytes) {
    return static_cast<std::int32_t>(little_endian(bytes));
  }

  // Whether a list ends here, with an empty name.
  bool ends() {
    if (left_.empty() || left_.front() != '\0') return false;
    take(1);
    return true;
  }

  std::string_view name() {
    const std::size_t length = left_.substr(0, kLongestName + 1).find('\0');
    if (length == std::string_view::npos) throw std::runtime_error("its header is damaged");
    return take(length + 1).substr(0, length);
  }

  void check_part() {
    Part part;
    while (!ends()) {
      const std::string attribute(name());
      const std::string type(name());
      const std::int32_t size = number(take(4));
      if (size < 0 || static_cast<std::size_t>(size) > left_.size()) {
        throw std::runtime_error(fmt::format("its attribute {} claims {} bytes of the {} that are left",
                                             printable(attribute, kLongestName),
                                             static_cast<std::uint32_t>(size), left_.size()));
      }
      read(attribute, type, take(static_cast<std::size_t>(size)), part);
    }
    check_size(part);
  }

  void read(const std::string& attribute, const std::string& type, std::string_view value, Part& part) const {
    const auto at = [&](std::size_t i) { return static_cast<double>(number(value.substr(4 * i, 4))); };
    if (attribute == "dataWindow" && value.size() == 16) {
      part.width = at(2) - at(0) + 1.0;
      part.height = at(3) - at(1) + 1.0;
    } else if (attribute == "tiles" && value.size() == 9) {
      part.tile_width = static_cast<std::uint32_t>(number(value.substr(0, 4)));
      part.tile_height = static_cast<std::uint32_t>(number(value.substr(4, 4)));
    } else if (attribute == "compression" && value.size() == 1) {
      part.lines = lines_together(number(value));
    } else if (attribute == "channels") {
      part.channels = static_cast<double>(channels_in(value));
    } else if (attribute == "type" && value.starts_with("deep")) {
      throw std::runtime_error("it is deep; a picture must be flat");
    } else if (attribute == "chunkCount" && value.size() == 4) {
      check_blocks(static_cast<std::uint32_t>(number(value)));
    } else if (type == "preview" && (value.size() < 8 || at(0) < 0.0 || at(1) < 0.0 ||
                                     8.0 + 4.0 * at(0) * at(1) != static_cast<double>(value.size()))) {
      throw std::runtime_error(
          fmt::format("its preview has not the size it says, in {} bytes", value.size()));
    }
  }

  // Of OpenEXR's kinds of compression: none, RLE, ZIPS, ZIP, PIZ, PXR24, B44, B44A, DWAA, DWAB.
  static double lines_together(std::int32_t compression) {
    constexpr double kLines[] = {1, 1, 1, 16, 32, 16, 32, 32, 32, 256};
    if (compression < 0 || compression > 9)
      throw std::runtime_error(fmt::format("its compression is {}; it must be 0 to 9", compression));
    return kLines[compression];
  }

  // A name, then type, kind and sampling in 16 bytes, each.
  static std::size_t channels_in(std::string_view value) {
    constexpr std::size_t kAfterName = 17;
    std::size_t count = 0;
    for (; !value.empty() && value.front() != '\0'; ++count) {
      const std::size_t length = value.find('\0');
      if (length == std::string_view::npos || value.size() - length < kAfterName)
        throw std::runtime_error("its list of channels is damaged");
      value.remove_prefix(length + kAfterName);
    }
    return count;
  }

  void check_blocks(double count) const {
    if (count * kBytesPerOffset <= static_cast<double>(bytes_.size())) return;
    throw std::runtime_error(
        fmt::format("its {:.0f} blocks of pixels cannot be in {} bytes", count, bytes_.size()));
  }

  void check_size(const Part& part) const {
    require_picture_size(part.width, part.height, part.channels);
    const bool tiled = part.tile_width > 0.0 && part.tile_height > 0.0;
    const double width = tiled ? part.tile_width : part.width;
    const double height = tiled ? part.tile_height : part.lines;
    check_blocks(std::max(1.0, part.width / width) * std::max(1.0, part.height / height));
    if (width * height * part.channels > kMostBlockValues) {
      throw std::runtime_error(
          fmt::format("it has blocks of {:.0f} x {:.0f} pixels of {:.0f} channels; width x height x channels "
                      "must be at most {:.0f}",
                      width, height, part.channels, kMostBlockValues));
    }
  }

  std::string_view bytes_;
  std::string_view left_;
};

}  // namespace

void check_exr(std::string_view bytes) {
  ExrCheck(bytes).check();
}

}  // namespace solidnoise

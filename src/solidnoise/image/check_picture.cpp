#include "solidnoise/image/check_picture.h"

#include <algorithm>
#include <stdexcept>

#include <fmt/format.h>

#include "solidnoise/image/byte_order.h"

namespace solidnoise {
namespace {

// Whether a PNG file goes on up to its closing chunk. Where it does not, OpenImageIO's reader in memory leaks
// its message.
bool is_whole_png(std::string_view bytes) {
  constexpr std::size_t kSignature = 8;
  constexpr std::size_t kAroundData = 12;  // length, type and checksum of a chunk
  bytes.remove_prefix(kSignature);
  while (bytes.size() >= kAroundData) {
    const std::size_t length = kAroundData + big_endian(bytes.substr(0, 4));
    if (length > bytes.size()) return false;
    if (bytes.substr(4, 4) == "IEND") return true;
    bytes.remove_prefix(length);
  }
  return false;
}

// A progressive JPEG is held as a whole from the moment it is opened.
void check_jpeg(std::string_view bytes) {
  constexpr std::size_t kFrame = 8;  // bytes of a frame's header up to its number of channels
  bytes.remove_prefix(2);            // the marker of the beginning
  while (bytes.size() >= 4 && bytes[0] == '\xff') {
    const auto marker = static_cast<unsigned char>(bytes[1]);
    if (marker == 0xff) {  // padding
      bytes.remove_prefix(1);
      continue;
    }
    const std::size_t length = big_endian(bytes.substr(2, 2));
    // C4, C8 and CC are tables and an extension; scans begin at DA.
    const bool is_frame =
        marker >= 0xc0 && marker <= 0xcf && marker != 0xc4 && marker != 0xc8 && marker != 0xcc;
    if (is_frame && bytes.size() >= 2 + kFrame) {
      require_picture_size(static_cast<double>(big_endian(bytes.substr(7, 2))),
                           static_cast<double>(big_endian(bytes.substr(5, 2))),
                           static_cast<double>(big_endian(bytes.substr(9, 1))));
    }
    if (is_frame || marker == 0xda || 2 + length > bytes.size()) return;
    bytes.remove_prefix(2 + length);
  }
}

}  // namespace

void require_picture_size(double width, double height, double channels) {
  constexpr double kLongestSide = 1 << 20;
  if (std::max(width, height) > kLongestSide) {
    throw std::runtime_error(fmt::format("it has {:.0f} x {:.0f} pixels; a side must have at most {:.0f}",
                                         width, height, kLongestSide));
  }
  const double values = width * height * channels;
  if (width >= 1.0 && height >= 1.0 && channels >= 1.0 && values <= static_cast<double>(kMostPictureValues))
    return;
  throw std::runtime_error(fmt::format(
      "it has {:.0f} x {:.0f} pixels of {:.0f} channels; width x height x channels must be at most {}", width,
      height, channels, kMostPictureValues));
}

void check_picture(std::string_view format, std::string_view bytes) {
  if (format == "png" && !is_whole_png(bytes)) throw std::runtime_error("it is cut short");
  if (format == "jpeg") check_jpeg(bytes);
  if (format == "tiff") check_tiff(bytes);
  if (format == "openexr") check_exr(bytes);
}

}  // namespace solidnoise

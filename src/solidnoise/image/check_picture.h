#pragma once

#include <cstddef>
#include <string_view>

namespace solidnoise {

// Values (width x height x channels) that a picture may have to be read: a gigabyte of floats.
inline constexpr std::size_t kMostPictureValues = std::size_t{1} << 28;

// Refuses what has more, and sides of more than 2^20 pixels. Throws std::runtime_error, which says what is
// wrong but not with which file, as all of these do.
void require_picture_size(double width, double height, double channels);

// What OpenImageIO's reader of a format (its name) believes without looking, and takes memory for, before it
// says how large a picture is: the chunks of a PNG, the frame of a JPEG, the depth of a TIFF, the header of
// an OpenEXR file.
void check_picture(std::string_view format, std::string_view bytes);

// The directory of a TIFF's picture: image and tiles must be 1 deep. The reader takes memory for a tile's
// depth, and goes through it, whatever the picture's is.
void check_tiff(std::string_view bytes);

// The headers of an OpenEXR file's parts. No attribute, nor the table of where scan lines or tiles are, may
// be longer than the file; a part may have kMostPictureValues, and a quarter of that in a tile or in the
// lines that are compressed together, of which some are held at once.
void check_exr(std::string_view bytes);

}  // namespace solidnoise

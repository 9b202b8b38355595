#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "solidnoise/analysis/dense_field.h"
#include "solidnoise/core/image.h"
#include "solidnoise/core/progress.h"

namespace solidnoise {

// A texture to learn from: channels of one shape, 1 (grey) or 3 (red, green, blue). Of a picture the first
// axis is x, to the right, and the second y, up.
template <int Dim>
struct Exemplar {
  std::vector<DenseField<Dim>> channels;

  const DenseField<Dim>& shape() const { return channels.front(); }

  // Throws std::invalid_argument that begins with `name` for: no channels, or neither 1 nor 3, or of
  // different shapes, fewer than 16 samples along an axis, values that are not finite, values that are all
  // equal.
  void validate(const std::string& name) const;
};

struct ExemplarReading {
  double pixel_size = 1.0;  // world units; > 0
  bool raw_values = false;  // take values as they are stored; otherwise they become linear light
};

// The exemplar in a picture: pixels are taken as sRGB-encoded unless `reading` says raw. Three channels that
// are equal become one; an alpha channel (the second of two, the fourth of four) must be 1 everywhere. Throws
// std::invalid_argument that begins with `name`, as Exemplar::validate and for other numbers of channels.
Exemplar<2> exemplar_of_image(const Image& image, const ExemplarReading& reading, const std::string& name);

// The same from a file that OpenImageIO reads: 8 and 16 bits are sRGB-encoded, .exr files and Radiance's
// (.hdr, .rgbe, .pic) are linear light already. Throws std::runtime_error naming the path, and Cancelled
// where `progress` asks to stop. `before` is told the bytes of the pixels before they are taken, as
// read_image tells them; the exemplar takes at most as many once more.
Exemplar<2> read_exemplar(const std::filesystem::path& path, const ExemplarReading& reading = {},
                          Progress* progress = nullptr,
                          const std::function<void(std::uint64_t bytes)>& before = {});

// Whether a file holds linear light already, by its name.
bool holds_linear_light(const std::filesystem::path& path);

// The samples in the middle of a volume's third axis, looked at along it.
Exemplar<2> middle_slice(const Exemplar<3>& volume);

// A picture of an exemplar's kind back as pixels, not encoded; 3 channels, grey ones equal.
Image image_of_exemplar(const Exemplar<2>& exemplar);

// How far a texture is from a Gaussian one, which is all that noise can be: its spectrum says everything
// about a Gaussian texture, while in a structured one (bricks, leaves) the phases matter.
struct GaussianityReport {
  double skewness = 0.0;         // of the values; 0 for a Gaussian texture
  double excess_kurtosis = 0.0;  // of the values; 0
  // Excess kurtosis of the differences between samples at a distance, less that of the texture's own Gaussian
  // versions, for the distance at which it is largest: rare strong edges make it large, phases at random do
  // not. 0 for a Gaussian texture.
  double structure = 0.0;
  double significance = 0.0;  // of `structure`, in standard deviations of that of the Gaussian versions
  // How much more the strength of detail varies from place to place than in the Gaussian versions, 1 for a
  // Gaussian texture: the coefficient of variation of the energy, over a neighbourhood, of what differs from
  // the mean of the four samples at a distance of 1, 2 or 4, over that of the versions; the second largest of
  // the three. Shapes gather detail in some places, phases at random do not.
  double unevenness = 1.0;
  // What to tell the user, a line each; empty for a texture that noise can match.
  std::vector<std::string> warnings;
};

// Compares a field with `versions` of its Gaussian versions (gaussian_version).
GaussianityReport test_gaussianity(const DenseField<2>& field, int versions = 8, std::uint64_t seed = 0);

}  // namespace solidnoise

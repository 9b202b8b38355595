#pragma once

#include <functional>
#include <utility>
#include <vector>

namespace solidnoise {

// What cubes make of the mean square M of a kernel in `dimensions` dimensions, for cubes of a side in world
// units.
class CubeAverages {
 public:
  virtual ~CubeAverages() = default;

  // Integral over space of (h * M)^2.
  virtual double overlap(double side) const = 0;

  // Coefficient k >= 1 of the Fourier series of the same integrand, summed over planes of cubes, along their
  // normal, of which overlap() is coefficient 0: planes are all that is not shifted at random in one noise.
  virtual double harmonic(double side, int k) const = 0;
};

// Of a mean square that is radial, or has any orientation, by its Fourier transform.
class RadialAverages final : public CubeAverages {
 public:
  // M(r), which ends at `reach`; nothing in it is of frequencies over `highest`.
  static RadialAverages of(int dimensions, const std::function<double(double)>& mean_square, double reach,
                           double highest);

  // By its transform, of a frequency; of an M that is not radial the root of its mean square.
  RadialAverages(int dimensions, double reach, double highest,
                 const std::function<double(double)>& transform);

  double overlap(double side) const override;
  double harmonic(double side, int k) const override;

 private:
  friend class LayerAverages;
  double transform(double frequency) const;  // between nodes, linearly

  int dimensions_;
  double step_;                    // of frequency
  std::vector<double> transform_;  // of M, at multiples of the step
};

// Of a factor times a product of one function per axis, the same for all.
class ProductAverages final : public CubeAverages {
 public:
  ProductAverages(int dimensions, std::function<double(double)> of_axis, double reach, double factor)
      : dimensions_(dimensions), of_axis_(std::move(of_axis)), reach_(reach), factor_(factor) {}

  double overlap(double side) const override;
  double harmonic(double side, int k) const override;

 private:
  int dimensions_;
  std::function<double(double)> of_axis_;
  double reach_;
  double factor_;
};

// Of a layer around a plane in three dimensions: the product of a mean square in the plane and of one of
// the distance from it.
class LayerAverages final : public CubeAverages {
 public:
  // In the plane, of two dimensions; `across` ends at `thickness` on either side.
  LayerAverages(RadialAverages in_plane, const std::function<double(double)>& across, double thickness);

  double overlap(double side) const override;  // mean over all orientations
  double harmonic(double side,
                  int k) const override;  // of a layer along the planes of cubes, where it is most

 private:
  static constexpr double kHighestAcross =
      4.0;  // cycles in the thickness: of smooth windows nothing is above

  RadialAverages in_plane_;
  RadialAverages across_;
};

}  // namespace solidnoise

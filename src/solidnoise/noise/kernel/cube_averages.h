#pragma once

#include <functional>
#include <utility>
#include <vector>

namespace solidnoise {

// Cubes with impulses at uniform places in them: independent of each other, or in pairs, of which the places
// are each other's mirror image at the cube's centre.
struct Cubes {
  double side = 0.0;  // world units
  bool mirrored = false;

  int least() const { return mirrored ? 2 : 1; }  // impulses that a cube has
};

// Of two impulses of a cube.
enum class Places { independent, mirrored };

// What cubes make of the mean square M of a kernel in `dimensions` dimensions. With h the uniform density of
// a cube around 0 the mean of M around one place times M around the other is (h * M)^2 of two independent
// ones, and the mean over places x in the cube of M(p - x) M(p + x) of mirrored ones.
class CubeAverages {
 public:
  virtual ~CubeAverages() = default;

  // What strata take from the integral of E g^4, three times over, in the fourth cumulant: the integral over
  // space of that mean of independent places; of pairs, which are two impulses where independent ones would
  // be one, twice as much, less that of mirrored places.
  double overlap(const Cubes& cubes) const { return harmonic(cubes, 0); }

  // Coefficient k of the Fourier series of the same integrand, summed over planes of cubes, along their
  // normal, of which overlap() is coefficient 0: planes are all that is not shifted at random in one noise.
  double harmonic(const Cubes& cubes, int k) const {
    const double independent = coefficient(cubes.side, Places::independent, k);
    if (!cubes.mirrored) return independent;
    return 2.0 * independent - coefficient(cubes.side, Places::mirrored, k);
  }

 private:
  virtual double coefficient(double side, Places places, int k) const = 0;
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

 private:
  friend class LayerAverages;
  double coefficient(double side, Places places, int k) const override;
  double mean(double side, Places places) const;
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

 private:
  double coefficient(double side, Places places, int k) const override;

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

 private:
  // The integral is the mean over all orientations, harmonics are those of a layer along the planes of cubes,
  // where they are most.
  double coefficient(double side, Places places, int k) const override;

  static constexpr double kHighestAcross =
      4.0;  // cycles in the thickness: of smooth windows nothing is above

  RadialAverages in_plane_;
  RadialAverages across_;
};

}  // namespace solidnoise

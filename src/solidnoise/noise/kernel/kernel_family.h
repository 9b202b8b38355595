#pragma once

#include <deque>
#include <memory>
#include <mutex>
#include <optional>
#include <vector>

#include "solidnoise/noise/kernel/compact_kernel.h"
#include "solidnoise/noise/kernel/impulse_statistics.h"

namespace solidnoise {

// What a Gabor kernel is made of besides its envelope: plane waves from all directions, or one plane wave.
enum class GaborWaves { isotropic, oriented };

// The compact Gabor kernels of all bandwidths, in n dimensions and on the unit ball:
//   isotropic: k(x) = t^4 P(v), the compact form of an isotropic Gabor kernel of unit peak;
//   oriented:  k(x) = t^4 P(v) cos(2 pi c u.x), that of a Gaussian times a wave along a unit vector u.
// A Gabor kernel of frequency F0 is k(x / r) with r = cycles / F0, where `cycles` is how many periods of the
// wave there are in the radius. The phase is 0 so that u and -u are the same kernel: a field of directions
// needs no signs.
//
// A kernel between tabulated ones (at equal steps of `cycles`) is interpolated linearly between the two
// neighbours, coefficient by coefficient. Its energy is that of the interpolated kernel, so that a noise
// normalised by it has exactly the variance that it should (isotropic: the energy is a quadratic polynomial
// between two bandwidths, and known exactly; oriented: to 2e-5). All kernels have the same product of radius
// and Gaussian parameter a, that of the cheapest compact kernel of the reference bandwidth, at which the
// family is exactly that kernel.
//
// Tabulated kernels are made when they are first asked for. May be shared between threads.
class KernelFamily {
 public:
  static constexpr double kLeastBandwidth = 0.1;  // octaves
  static constexpr double kMostBandwidth = 4.0;
  static constexpr double kStep = 0.05;         // between tabulated kernels, in cycles
  static constexpr int kMostHornerDegree = 12;  // that Horner's rule is compiled for

  // `bandwidth`: the reference, in octaves; `error`: relative RMS error of its compact kernel, of values, or
  // of values and gradient (of waves on average over their phases). Others may have an error up to three
  // times that.
  KernelFamily(int dimensions, GaborWaves waves, double bandwidth, double error,
               bool bounds_gradient = false);

  int dimensions() const { return dimensions_; }
  GaborWaves waves() const { return waves_; }
  // The radius of a kernel at kNominalError over its radius here, the same for all.
  double nominal_share() const { return nominal_share_; }

  // A tabulated kernel, and its polynomial in single precision as the sums take it: P in powers of v, or t P
  // in Chebyshev polynomials of 2 v.
  struct Tabulated {
    CompactKernel kernel;  // on the unit ball
    double cycles;
    bool power = false;  // whether Horner's rule is accurate enough
    std::vector<float> coefficients;
    std::vector<float> chebyshev;
  };

  // A kernel of the family: (1 - blend) lower + blend upper.
  struct Member {
    const Tabulated* lower = nullptr;
    const Tabulated* upper = nullptr;
    double blend = 0.0;
    double cycles = 0.0;
    double energy = 0.0;  // integral of k^2 over the unit ball

    bool power() const { return lower->power && upper->power; }
    int degree() const;
  };
  // Precondition: bandwidth from kLeastBandwidth to kMostBandwidth. Of an oriented kernel, `coherence`, 0 to
  // 1, is by how much its wave is longer, in the same envelope: at 0 the envelope is left.
  Member at(double bandwidth, double coherence = 1.0) const;
  // Periods of the wave in the radius, at a coherence of 1.
  double cycles(double bandwidth) const;

  // What a filter (gaussian_filter.h) of a standard deviation in world units, > 0, makes of a kernel: one of
  // `widening` times its radius, `frequency` in the place of its own, and `peak` times as high; a peak of 0
  // where nothing is left of it (FilteredShare). Beyond a bandwidth of kMostBandwidth, where it is a Gaussian
  // but for the error, its wave is that of kMostBandwidth.
  struct Filtered {
    Member kernel;
    double frequency = 0.0;
    double widening = 1.0;
    double peak = 1.0;
    double variance = 1.0;  // of the noise, that of the unfiltered noise being 1
  };
  Filtered filtered(double frequency, double bandwidth, double deviation, double coherence = 1.0) const;

  // For an oriented kernel, its envelope.
  CompactKernel compact(const Member& member) const;
  // Integrals of k^2 and k^4 over the unit ball.
  KernelMoments moments(const Member& member) const;

 private:
  // A tabulated kernel and the energies half-way to, and at, the next.
  struct Node {
    std::once_flag made;
    std::once_flag linked;
    std::unique_ptr<const Tabulated> tabulated;
    double energy[3] = {};
  };

  const Tabulated& tabulated(int step) const;
  const Node& interval(int step) const;
  std::unique_ptr<const Tabulated> make(int step) const;

  int dimensions_;
  GaborWaves waves_;
  double bandwidth_;
  double error_;
  bool bounds_gradient_;
  double radius_times_a_ = 0.0;
  double nominal_share_ = 1.0;
  double reference_cycles_ = 0.0;
  std::optional<CompactKernel> reference_;
  int first_ = 0;  // step of the first node; step 0 is the reference
  mutable std::deque<Node> nodes_;
};

}  // namespace solidnoise

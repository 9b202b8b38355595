#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "solidnoise/noise/convolution/impulse_process.h"
#include "solidnoise/noise/convolution/impulse_sums.h"
#include "solidnoise/noise/noise.h"

namespace solidnoise {

// Attributes of impulses, one array per channel.
using ImpulseAttributes = std::array<std::vector<float>, ImpulseList::kMaxAttributes>;

// What distinguishes one sparse convolution noise from another: what an impulse carries, and the kernel it
// carries.
class ImpulseKernel {
 public:
  virtual ~ImpulseKernel() = default;

  virtual CullBox::Support support() const = 0;
  virtual int attribute_count() const = 0;

  // Draws the attributes of the impulses with these marks.
  virtual void draw(std::span<const std::uint64_t> marks, ImpulseAttributes& attributes) const = 0;

  // Sums the kernels of all impulses of the list at all samples.
  virtual void sum(const ImpulseList& list, const SampleBrick& brick, Derivatives derivatives,
                   BrickSums& sums) const = 0;
  virtual void sum(const ImpulseList& list, const SampleCluster& cluster, Derivatives derivatives,
                   ClusterSums& sums) const = 0;
};

// Blocks that more impulses, or cells, can reach make them brick by brick, to bound memory.
inline constexpr double kMostImpulsesInBlock = 1 << 19;

// Sparse convolution: the sum of a kernel over the impulses of a process, times an amplitude. Makes
// the impulses once per block, culls them per brick of up to 8^3 samples, and leaves the sums to the kernel.
template <int Dim>
class SparseConvolution {
 public:
  // `radius` of the kernel's support in cells, per axis. Without a kernel the noise is 0.
  SparseConvolution(ImpulseProcess<Dim> process, std::shared_ptr<const ImpulseKernel> kernel,
                    const std::array<double, Dim>& radius, double amplitude);

  const ImpulseProcess<Dim>& process() const { return process_; }
  double amplitude() const { return amplitude_; }

  std::unique_ptr<FieldBlock<Dim>> block(const Box<Dim>& box) const;
  void evaluate(const Points<Dim>& points, const Samples<Dim>& samples) const;

 private:
  class Block;
  struct Source;
  struct Neighbourhood;
  class PointSource;

  ImpulseReach<Dim> reach_of(const Neighbourhood& neighbourhood) const;
  void gather(const Source& source, const Neighbourhood& neighbourhood, ImpulseList& list) const;

  ImpulseProcess<Dim> process_;
  std::shared_ptr<const ImpulseKernel> kernel_;
  Index<Dim> reach_{1};                // cells beyond that of a sample whose impulses may reach it
  std::array<float, kRoles> scale_{};  // cells to radii, per role; 0 for roles that the noise does not have
  std::array<float, Dim> slope_{};  // derivative per radius to derivative per world unit, times the amplitude
  double amplitude_;
};

// Cells to radii of the support, per role, from the radius in cells per axis; 0 for roles that do not exist.
template <int Dim>
std::array<float, kRoles> support_scale(const std::array<double, Dim>& radius) {
  std::array<float, kRoles> scale{};
  for (int axis = 0; axis < Dim; ++axis)
    scale[role_of_axis<Dim>(axis)] = static_cast<float>(1.0 / radius[axis]);
  return scale;
}

}  // namespace solidnoise

#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "solidnoise/core/vec.h"
#include "solidnoise/field/pointwise_field.h"
#include "solidnoise/noise/kernel/kernel_family.h"
#include "solidnoise/volume/parameters/parameter_grids.h"
#include "solidnoise/volume/topology/topology.h"
#include "solidnoise/volume/vdb/openvdb.h"

namespace solidnoise {

// Which values of a parameter are allowed, with words for it.
struct AllowedValues {
  double lowest = 0.0;
  double highest = 0.0;
  std::string_view allowed;
  bool without_lowest = false;

  // In single precision, in which grids have them. False for not-a-number.
  bool allows(double value) const {
    const auto v = static_cast<float>(value);
    const auto lower = static_cast<float>(lowest);
    return (without_lowest ? v > lower : v >= lower) && v <= static_cast<float>(highest);
  }
};

// Limits at which lengths and kernels stay finite in single precision.
inline constexpr AllowedValues kFrequencyRange{0.0, 1e12, "greater than 0 (cycles per world unit)", true};
inline constexpr AllowedValues kBandwidthRange{KernelFamily::kLeastBandwidth, KernelFamily::kMostBandwidth,
                                               "between 0.1 and 4 (octaves)"};
inline constexpr AllowedValues kMagnitudeRange{0.0, 1e12, "at least 0 (sigmas)"};

// A grid of floats as a parameter, anywhere in the world: interpolated trilinearly, whatever the grid's
// transform, and where there is a map mapped then.
class ScalarField final : public PointwiseField {
 public:
  // Reads the grid and notes its digest in `source`; `flag` is what messages advise to give. Throws
  // std::runtime_error naming the file: it cannot be read, has no such grid, no active voxels, or active
  // values that are not in the range (how many and where the first is).
  ScalarField(ParameterGrid& source, const std::string& flag, const AllowedValues& range,
              Progress* progress = nullptr);

  // Throws std::runtime_error naming the file and the first position whose value is not allowed.
  void evaluate(const Points<3>& points, const Samples<3>& samples) const override;

  // Throws std::runtime_error if the value is not allowed at some of the voxels, as where the grid has none
  // and its background is 0: naming the file, how many voxels, and where the first is.
  void require_allowed_at(const Topology& topology) const;

  // Least and greatest parameter of the active voxels.
  float least() const { return least_; }
  float greatest() const { return greatest_; }

  const std::string& name() const { return name_; }  // "f.vdb: grid 'paint'"
  const openvdb::FloatGrid& grid() const { return *grid_; }

 private:
  class Sampler;

  float mapped(float value) const;
  bool allows(float value) const;
  void require_allowed_values();
  // Of messages: what a value must be, and why it may be another one.
  std::string refusal(const std::string& why) const;
  std::string outside() const;

  openvdb::FloatGrid::ConstPtr grid_;
  std::optional<ValueMap> map_;
  bool by_ratio_ = false;
  double octaves_ = 0.0;  // from at_low to at_high
  AllowedValues range_;
  std::string name_;
  std::string map_flag_;
  bool all_allowed_ = false;  // of all values that there are, active or not
  float least_ = 0.0f;
  float greatest_ = 0.0f;
};

}  // namespace solidnoise

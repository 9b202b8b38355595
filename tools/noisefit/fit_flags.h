#pragma once

#include <string>
#include <type_traits>
#include <vector>

#include "common/field_flags.h"
#include "common/run_options.h"
#include "noisefit/model_file.h"
#include "solidnoise/analysis/exemplar/exemplar.h"
#include "solidnoise/analysis/exemplar/fit_exemplar.h"

namespace solidnoise {

// What fits to pictures and to volumes have in common.
struct FitOptions : RunOptions {
  FitOutputs outputs;
  ExemplarFitOptions fit;
  std::uint64_t seed = 1;  // of the textures in the sheet
};

constexpr auto fields_of(std::type_identity<FitOptions>) {
  return list_fields(field("seed", &FitOptions::seed, "Of the textures in the sheet"));
}

constexpr auto fields_of(std::type_identity<ExemplarReading>) {
  using Reading = ExemplarReading;
  return list_fields(
      field("pixel_size", &Reading::pixel_size, between(1e-9, 1e9), "world units", "Side of a pixel"),
      field("raw_values", &Reading::raw_values,
            "Take values as they are stored; otherwise they become linear light"));
}

constexpr auto fields_of(std::type_identity<SpectrumFitOptions>) {
  using Options = SpectrumFitOptions;
  constexpr Interval kShares{.least = 0.0, .most = 1.0, .without_least = true};
  return list_fields(
      field("kappa", &Options::kappa, kShares, "", "Fewer components against accuracy"),
      field("gap", &Options::gap_tolerance, kShares, "", "Duality gap at which a solution is accepted"),
      field("narrowest_band", &Options::narrowest_band,
            "Components as narrow as one frequency, for periodic textures"));
}

inline constexpr Choices<ColorAxes, 3> kColorAxesChoices{
    {{ColorAxes::independent, "independent"}, {ColorAxes::pca, "pca"}, {ColorAxes::rgb, "rgb"}}};

constexpr auto fields_of(std::type_identity<ExemplarFitOptions>) {
  using Options = ExemplarFitOptions;
  return list_fields(field("axes", &Options::axes, kColorAxesChoices, "The channels of a coloured noise"));
}

// Declares --out, --preview, --seed, --force and --quiet.
void declare_output_flags(FlagSet& flags, FitOptions& options, const std::string& sheet);
// Declares --patch, the size of what is averaged over.
void declare_patch_flag(FlagSet& flags, FitOptions& options, const std::string& unit);

// What decides how much a fit takes. Samples are those of all channels.
struct FitSize {
  double held = 0.0;    // bytes of the program and of what it has read
  double read = 0.0;    // samples of all exemplars
  double fitted = 0.0;  // samples of a patch
  double tested = 0.0;  // pixels of the largest picture that is tested for structure
  double drawn = 0.0;   // samples of what the sheet shows; 0: there is none
};

// Bytes of the program alone, the second where it reads or writes pictures: most are OpenImageIO's.
inline constexpr double kProgramBytes = 44.0 * 0x1p20;
inline constexpr double kPictureProgramBytes = 140.0 * 0x1p20;

// What is read, fitted and, of the first two axes of the first exemplar, drawn.
template <int Dim>
FitSize fit_size(const std::vector<Exemplar<Dim>>& exemplars, const FitOptions& options);

// Throws std::runtime_error if a fit may take more than is allowed.
void require_fit_cost(const FitOptions& options, const FitSize& size);

extern template FitSize fit_size(const std::vector<Exemplar<2>>&, const FitOptions&);
extern template FitSize fit_size(const std::vector<Exemplar<3>>&, const FitOptions&);

// Parses and applies the flags, and checks what they say. Throws UsageError.
void parse_fit(FlagSet& flags, const std::vector<std::string>& arguments, FitOptions& options);

}  // namespace solidnoise

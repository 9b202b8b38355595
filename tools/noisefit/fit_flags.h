#pragma once

#include <string>
#include <type_traits>
#include <vector>

#include "common/field_flags.h"
#include "common/run_options.h"
#include "noisefit/model_file.h"
#include "solidnoise/analysis/exemplar/fit_fields.h"

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

// Parses and applies the flags, and checks what they say. Throws UsageError.
void parse_fit(FlagSet& flags, const std::vector<std::string>& arguments, FitOptions& options);

}  // namespace solidnoise

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <numbers>
#include <string>
#include <vector>

#include "papers/data_file.h"
#include "papers/items.h"
#include "papers/strata_sample.h"
#include "solidnoise/noise/gabor/gabor_noise.h"
#include "solidnoise/noise/gabor/oriented_gabor_noise.h"
#include "solidnoise/noise/kernel/impulse_strata.h"

namespace solidnoise::papers {
namespace {

namespace fs = std::filesystem;

constexpr int kSeeds = 400;
constexpr int kWindowSeeds = 200;

// The two kinds of kernels: isotropic ones of random signs, and waves of random direction and phase. A wave a
// unit, one octave.
template <int Dim>
struct Isotropic {
  static constexpr double kKind = 0.0;
  using Noise = GaborNoise<Dim>;
  GaborNoiseOptions options{.frequency = 1.0};

  static StrataChoice choice(const Noise& noise) { return strata_choice(noise.kernel(), {}); }
};
template <int Dim>
struct AllDirections {
  static constexpr double kKind = 1.0;
  using Noise = OrientedGaborNoise<Dim>;
  OrientedGaborNoiseOptions options{.frequency = 1.0};

  static StrataChoice choice(const Noise& noise) { return strata_choice(noise.kernel()); }
};

// Calls measure(kind) with both kinds in 1 to 4 dimensions.
template <typename Measure>
void for_each_kind(const Measure& measure) {
  const auto both = [&]<int Dim>() {
    measure.template operator()<Dim>(Isotropic<Dim>());
    measure.template operator()<Dim>(AllDirections<Dim>());
  };
  both.template operator()<1>();
  both.template operator()<2>();
  both.template operator()<3>();
  both.template operator()<4>();
}

template <int Dim, typename Kind>
MakeNoise<Dim> maker(const Kind& kind) {
  return [options = kind.options](std::uint64_t seed) mutable {
    options.seed = seed;
    return std::make_unique<const typename Kind::Noise>(options);
  };
}

// As many impulses as a Poisson process.
template <typename Kind>
Kind poisson(Kind kind) {
  kind.options.impulses = typename Kind::Noise(kind.options).impulses_per_kernel();
  kind.options.impulses_process = ImpulseSpread::poisson;
  return kind;
}

void append(std::vector<double>& row, const Estimate& estimate) {
  row.push_back(estimate.value);
  row.push_back(estimate.error);
}

// Moments and tails of strata and of a Poisson process of as many impulses.
void write_ensembles(const fs::path& folder) {
  Table table{{"n", "kind", "poisson", "impulses", "side", "closed", "given_place", "mean", "mean_error",
               "variance", "variance_error", "kurtosis", "kurtosis_error", "beyond_3", "beyond_3_error",
               "beyond_4", "beyond_4_error"},
              {}};
  for_each_kind([&]<int Dim, typename Kind>(const Kind& strata) {
    for (const Kind& kind : {strata, poisson(strata)}) {
      const typename Kind::Noise noise(kind.options);
      const Ensemble found = measure_ensemble<Dim>(maker<Dim>(kind), 1.1 * noise.radius(), kSeeds);
      const bool is_poisson = kind.options.impulses_process == ImpulseSpread::poisson;
      std::vector<double> row{Dim,
                              Kind::kKind,
                              is_poisson ? 1.0 : 0.0,
                              noise.impulses_per_kernel(),
                              noise.impulses().axes()[0].size() * noise.kernel().a(),
                              noise.excess_kurtosis(),
                              noise.kurtosis_given_place()};
      for (const Estimate& estimate :
           {found.mean, found.variance, found.excess_kurtosis, found.beyond_3, found.beyond_4}) {
        append(row, estimate);
      }
      table.rows.push_back(row);
    }
  });
  write_table(folder / "strata_ensembles.csv", table);
}

// The fourth cumulant over that of a Poisson process, for cubes of sides times a.
void write_sides(const fs::path& folder) {
  Table table{{"side"}, {}};
  for (double side = 0.05; side <= 2.0; side += 0.05) table.rows.push_back({side});
  for_each_kind([&]<int Dim, typename Kind>(const Kind& kind) {
    const typename Kind::Noise noise(kind.options);
    const StrataChoice choice = Kind::choice(noise);
    table.names.push_back(std::string(Kind::kKind == 0.0 ? "isotropic" : "directions") + std::to_string(Dim));
    for (std::vector<double>& row : table.rows) {
      row.push_back(1.0 -
                    3.0 * choice.averages->overlap(row[0] / noise.kernel().a()) / choice.moments.fourth);
    }
  });
  write_table(folder / "strata_sides.csv", table);
}

// By how much strata are shifted along the first axis, in cells: the least place of many impulses.
double first_shift(const ImpulseProcess<2>& process) {
  double least = 1.0;
  for (std::int64_t i = 0; i < 4096; ++i) {
    process.generate(Index<2>(0, i), [&](const Impulse<2>& impulse) {
      least = std::min(least, impulse.position[0] / static_cast<double>(CellAxis::kQuantaPerCell));
    });
  }
  return least;
}

// The excess kurtosis at places between two planes of strata, 0 to 1 from one to the next.
void write_places(const fs::path& folder) {
  constexpr int kPlaces = 12;
  constexpr int kBatches = 20;
  constexpr int kAlong = 64;  // samples along the planes
  Table table{{"kind", "place", "closed", "kurtosis", "kurtosis_error"}, {}};
  const auto measure = [&]<typename Kind>(const Kind& first) {
    std::vector<std::vector<double>> fourth(kPlaces);
    Kind kind = first;
    for (int batch = 0; batch < kBatches; ++batch) {
      std::vector<double> sums(kPlaces, 0.0);
      for (int seed = batch; seed < kSeeds; seed += kBatches) {
        kind.options.seed = static_cast<std::uint64_t>(seed);
        const typename Kind::Noise noise(kind.options);
        const double cell = noise.impulses().axes()[0].size();
        Lattice<2> lattice;
        lattice.origin[0] = first_shift(noise.impulses()) * cell + 0.5 * cell / kPlaces;
        // Each row is a place further, and planes enough for it to be independent.
        lattice.step = {cell * (std::ceil(noise.radius() / cell) + 1.0 / kPlaces), 1.1 * noise.radius()};
        lattice.count = {kAlong / kPlaces * kPlaces, kAlong};
        std::vector<float> values(lattice.size());
        noise.evaluate(lattice, {.values = values});
        for (std::size_t i = 0; i < values.size(); ++i) {
          sums[i / kAlong % kPlaces] += std::pow(values[i], 4);
        }
      }
      const double count = kSeeds / kBatches * (kAlong / kPlaces) * static_cast<double>(kAlong);
      for (std::size_t place = 0; place < kPlaces; ++place) {
        fourth[place].push_back(sums[place] / count - 3.0);  // the variance is 1 at every place
      }
    }
    const typename Kind::Noise noise(first.options);
    const StrataChoice choice = Kind::choice(noise);
    const double side = noise.impulses().axes()[0].size();
    for (std::size_t place = 0; place < kPlaces; ++place) {
      const double at = (static_cast<double>(place) + 0.5) / kPlaces;
      KernelMoments moments = choice.moments;
      moments.overlap = choice.averages->overlap(side);
      for (int k = 1; k <= 2; ++k) {
        moments.overlap +=
            2.0 * choice.averages->harmonic(side, k) * std::cos(2.0 * std::numbers::pi * k * (at - 0.5));
      }
      std::vector<double> row{Kind::kKind, at, noise_excess_kurtosis(noise.impulse_density(), moments)};
      append(row, estimate(fourth[place]));
      table.rows.push_back(row);
    }
  };
  measure(Isotropic<2>());
  measure(AllDirections<2>());
  write_table(folder / "strata_places.csv", table);
}

void write_windows(const fs::path& folder) {
  Table table{{"kind", "poisson", "impulses", "side", "spread", "spread_error"}, {}};
  const auto measure = [&]<typename Kind>(const Kind& strata) {
    for (const Kind& kind : {strata, poisson(strata)}) {
      const typename Kind::Noise noise(kind.options);
      const bool is_poisson = kind.options.impulses_process == ImpulseSpread::poisson;
      for (const WindowPower& window : measure_windows(maker<2>(kind), noise.radius(), kWindowSeeds)) {
        table.rows.push_back({Kind::kKind, is_poisson ? 1.0 : 0.0, noise.impulses_per_kernel(), window.side,
                              window.spread.value, window.spread.error});
      }
    }
  };
  measure(Isotropic<2>());
  measure(AllDirections<2>());
  write_table(folder / "strata_windows.csv", table);
}

// How far noises of larger errors are from the one of a small error: root mean square and correlation.
void write_drafts(const fs::path& folder) {
  constexpr int kDraftSeeds = 16;
  constexpr double kFinal = 0.002;
  constexpr std::array kAcross = {1024, 64, 24, 10};
  Table table{{"n", "kind", "error", "difference", "correlation"}, {}};
  for_each_kind([&]<int Dim, typename Kind>(Kind kind) {
    const auto values_of = [&](double error, int seed) {
      kind.options.error = error;
      kind.options.seed = static_cast<std::uint64_t>(seed);
      Lattice<Dim> lattice;
      lattice.step = Vec<Dim>(0.31);  // of a wave
      lattice.count = glm::vec<Dim, int>(kAcross[Dim - 1]);
      std::vector<float> values(lattice.size());
      typename Kind::Noise(kind.options).evaluate(lattice, {.values = values});
      return values;
    };
    for (const double error : {0.2, 0.1, 0.05, 0.02}) {
      double squares = 0.0;
      double product = 0.0;
      double power_of_draft = 0.0;
      double power = 0.0;
      for (int seed = 0; seed < kDraftSeeds; ++seed) {
        const std::vector<float> final_values = values_of(kFinal, seed);
        const std::vector<float> draft = values_of(error, seed);
        for (std::size_t i = 0; i < draft.size(); ++i) {
          squares += std::pow(draft[i] - final_values[i], 2);
          product += draft[i] * final_values[i];
          power_of_draft += std::pow(draft[i], 2);
          power += std::pow(final_values[i], 2);
        }
      }
      table.rows.push_back(
          {Dim, Kind::kKind, error, std::sqrt(squares / power), product / std::sqrt(power_of_draft * power)});
    }
  });
  write_table(folder / "strata_drafts.csv", table);
}

void write_strata(const fs::path& folder) {
  write_sides(folder);
  write_ensembles(folder);
  write_places(folder);
  write_windows(folder);
  write_drafts(folder);
}

}  // namespace

Items strata_items() {
  return {{"strata", write_strata}};
}

}  // namespace solidnoise::papers

#include "solidnoise/analysis/exemplar/sparse_fit.h"

#include <cmath>
#include <cstddef>
#include <numbers>
#include <stdexcept>
#include <vector>

#include <gtest/gtest.h>

#include "solidnoise/core/vec.h"
#include "support/golden.h"

namespace solidnoise::sparse_fit_test {
namespace {

// The golden 16 x 16 problem: two bands, Gaussians at every frequency.
struct SmallProblem {
  nlohmann::json golden_values = golden("exemplar.json")["gnbe_small"];
  GaussianAtoms atoms{{2, {16, 1, 16}, {1.0 / 16, 1.0, 1.0 / 16}},
                      {{band_a(2), {1, 1, 1}}, {band_a(3), {1, 1, 1}}}};

  static double band_a(int b) {
    return std::sqrt(std::numbers::pi / (2.0 * std::numbers::ln2)) * std::exp2(-b);
  }

  // The components' pairs of Gaussians, K^2 / 8 a^2 times a normalised Gaussian of deviation a / (2 sqrt pi).
  std::vector<double> spectrum() const {
    std::vector<double> result(256, 0.0);
    for (const nlohmann::json& component : golden_values["components"]) {
      const double a = band_a(component["b"]);
      const double k = component["K"];
      for (int i = 0; i < 256; ++i) {
        for (int image = 0; image < 49; ++image) {
          for (const double sign : {-1.0, 1.0}) {
            const double f0 = i / 16 / 16.0 + image / 7 - 3 - sign * component["m0"].get<double>() / 16.0;
            const double f1 = i % 16 / 16.0 + image % 7 - 3 - sign * component["m1"].get<double>() / 16.0;
            result[static_cast<std::size_t>(i)] +=
                k * k / (8.0 * a * a) * 2.0 / (a * a) *
                std::exp(-2.0 * std::numbers::pi * (f0 * f0 + f1 * f1) / (a * a));
          }
        }
      }
    }
    return result;
  }
};

// The spectrum that lags are the transform of, by definition: their mean times cos(2 pi k.t/n) over all lags.
std::vector<double> spectrum_of(const std::vector<double>& lags, const FrequencyGrid& grid) {
  const auto [n0, n1, n2] = grid.count;
  std::vector<double> spectrum(grid.size(), 0.0);
  for (std::size_t t = 0; t < lags.size(); ++t) {
    const int t0 = static_cast<int>(t) / (n1 * n2);
    const double both_signs = t0 == 0 || 2 * t0 == n0 ? 1.0 : 2.0;  // -t is stored too, or not
    const Vec<3> turns(double(t0) / n0, double(static_cast<int>(t) / n2 % n1) / n1,
                       double(static_cast<int>(t) % n2) / n2);
    for (std::size_t i = 0; i < spectrum.size(); ++i) {
      const int k = static_cast<int>(i);
      const double turn = k / (n1 * n2) * turns.x + k / n2 % n1 * turns.y + k % n2 * turns.z;
      spectrum[i] += both_signs * lags[t] * std::cos(2.0 * std::numbers::pi * turn) /
                     static_cast<double>(spectrum.size());
    }
  }
  return spectrum;
}

// The golden figures are in double precision; the transforms round at 1e-15 of the largest value.
TEST(GaussianAtoms, MeetTheGoldenNormAndCorrelation) {
  const SmallProblem problem;
  const std::vector<double> spectrum = problem.spectrum();
  for (const nlohmann::json& at : problem.golden_values["S_at"]) {
    const std::size_t index = at["m0"].get<std::size_t>() * 16 + at["m1"].get<std::size_t>();
    EXPECT_NEAR(spectrum[index], at["S"].get<double>(), 1e-12);
  }
  // An upper estimate by about 1 %.
  const double norm = problem.golden_values["lipschitz_2normS2"];
  EXPECT_GE(2.0 * problem.atoms.norm_squared(), norm);
  EXPECT_LE(2.0 * problem.atoms.norm_squared(), 1.011 * norm);
}

TEST(GaussianAtoms, TransformASpectrumAsDefined) {
  const SmallProblem problem;
  const std::vector<double> spectrum = problem.spectrum();
  const std::vector<double> back = spectrum_of(problem.atoms.lags_of(spectrum), problem.atoms.grid());
  for (std::size_t i = 0; i < spectrum.size(); ++i) EXPECT_NEAR(back[i], spectrum[i], 1e-13);
}

// Counts with every parity, spacings above 1, in 2D and 3D.
TEST(GaussianAtoms, CorrelateIsTheTransposeOfSynthesize) {
  const std::vector<GaussianAtoms> cases = [] {
    std::vector<GaussianAtoms> result;
    result.emplace_back(FrequencyGrid{2, {12, 1, 15}, {0.1, 1.0, 0.07}},
                        std::vector<AtomBand>{{0.3, {3, 1, 5}}, {0.15, {1, 1, 1}}, {0.5, {4, 1, 3}}});
    result.emplace_back(FrequencyGrid{3, {6, 9, 8}, {0.1, 0.1, 0.1}},
                        std::vector<AtomBand>{{0.3, {2, 3, 2}}, {0.2, {1, 1, 1}}, {0.4, {3, 3, 4}}});
    return result;
  }();
  for (const GaussianAtoms& atoms : cases) {
    // Each pair by its definition, at the frequency that frequency_index() says.
    const FrequencyGrid& grid = atoms.grid();
    GaussianAtoms::Coefficients x = atoms.zeros();
    std::vector<double> lags;
    for (std::size_t band = 0; band < x.size(); ++band) {
      for (std::size_t i = 0; i < x[band].size(); ++i) {
        const Counts3 w = atoms.frequency_index(band, i);
        GaussianAtoms::Coefficients one = atoms.zeros();
        for (std::size_t j = 0; j < x[band].size(); ++j) {
          const Counts3 other = atoms.frequency_index(band, j);
          bool same = true;
          bool opposite = true;
          for (std::size_t axis = 0; axis < 3; ++axis) {
            same = same && (w[axis] - other[axis]) % grid.count[axis] == 0;
            opposite = opposite && (w[axis] + other[axis]) % grid.count[axis] == 0;
          }
          if (same || opposite) one[band][j] = 1.0;
        }
        EXPECT_EQ(atoms.sum(one), 1.0);
        atoms.synthesize(one, lags);
        const std::vector<double> spectrum = spectrum_of(lags, grid);
        std::vector<double> expected(spectrum.size(), 0.0);
        double energy = 0.0;
        for (std::size_t k = 0; k < expected.size(); ++k) {
          const int at[3] = {static_cast<int>(k) / (grid.count[1] * grid.count[2]),
                             static_cast<int>(k) / grid.count[2] % grid.count[1],
                             static_cast<int>(k) % grid.count[2]};
          double h[3] = {1.0, 1.0, 1.0};  // at w, -w and 0
          for (std::size_t axis = 0; axis < 3; ++axis) {
            double sums[3] = {0.0, 0.0, 0.0};
            for (int image = -4; image <= 4; ++image) {
              const double position = at[axis] + image * grid.count[axis];
              const double centres[3] = {double(w[axis]), -double(w[axis]), 0.0};
              for (int c = 0; c < 3; ++c) {
                const double f = grid.step[axis] * (position - centres[c]) / atoms.bands()[band].a;
                sums[c] += std::exp(-2.0 * std::numbers::pi * f * f);
              }
            }
            if (grid.dimensions == 2 && axis == 1) continue;
            for (int c = 0; c < 3; ++c) h[c] *= sums[c];
          }
          expected[k] = h[0] + h[1];
          energy += h[2] * h[2];
        }
        // Images further out than the dictionary's 3 matter below 1e-9.
        for (std::size_t k = 0; k < expected.size(); ++k) {
          EXPECT_NEAR(spectrum[k], expected[k] / std::sqrt(2.0 * energy), 1e-9);
        }
        if (i % 7 != 0) continue;
        // <S e_i, S e_j> = <e_j, S^T S e_i>.
        atoms.correlate(lags, x);
        EXPECT_NEAR(atoms.dot(x, one), atoms.dot(lags, lags), 1e-12);
      }
    }
  }
}

TEST(SparseFit, MeetsTheGoldenOptimum) {
  const SmallProblem problem;
  const std::vector<double> lags = problem.atoms.lags_of(problem.spectrum());
  SparseFitOptions options;
  options.kappa = problem.golden_values["kappa"];
  options.gap_tolerance = 1e-8;
  options.iterations_per_level = 20000;
  const SparseFit fit = fit_sparse(problem.atoms, lags, options);
  EXPECT_NEAR(fit.nu_max, problem.golden_values["nu_max"].get<double>(), 1e-10 * fit.nu_max);
  const double optimum = problem.golden_values["objective_opt"];
  EXPECT_NEAR(fit.objective, optimum, 1e-6 * optimum);
  EXPECT_GE(fit.gap, -1e-10 * optimum);
  EXPECT_LE(fit.gap, 1e-8 * optimum);
  EXPECT_NEAR(fit.residual, problem.golden_values["rel_residual"].get<double>(), 1e-4);
  for (const std::vector<double>& band : fit.x) {
    for (const double value : band) EXPECT_GE(value, 0.0);
  }
}

TEST(SparseFit, LeavesNothingAtTheLargestPenalty) {
  const SmallProblem problem;
  SparseFitOptions options;
  options.kappa = 1.0;
  const SparseFit fit = fit_sparse(problem.atoms, problem.atoms.lags_of(problem.spectrum()), options);
  EXPECT_EQ(problem.atoms.sum(fit.x), 0.0);
  EXPECT_NEAR(fit.gap, 0.0, 1e-9 * fit.objective);
}

struct Stopping final : Progress {
  int left;
  explicit Stopping(int after) : left(after) {}
  void advance(std::uint64_t, std::uint64_t) override { --left; }
  bool cancelled() override { return left <= 0; }
};

TEST(SparseFit, KeepsTheLastSolutionWhenItIsStopped) {
  const SmallProblem problem;
  Stopping stop(30);
  const SparseFit fit = fit_sparse(problem.atoms, problem.atoms.lags_of(problem.spectrum()), {}, &stop);
  EXPECT_TRUE(fit.interrupted);
  EXPECT_GE(fit.iterations, 30);
  EXPECT_LE(fit.iterations, 36);  // a level that ends does not report its last iteration
  EXPECT_GT(problem.atoms.sum(fit.x), 0.0);
  EXPECT_LT(fit.residual, 0.9);
}

TEST(SparseFit, RefusesNonsense) {
  const SmallProblem problem;
  const std::vector<double> lags = problem.atoms.lags_of(problem.spectrum());
  EXPECT_THROW(fit_sparse(problem.atoms, lags, {.kappa = 0.0}), std::invalid_argument);
  EXPECT_THROW(fit_sparse(problem.atoms, lags, {.kappa = 1.5}), std::invalid_argument);
  const std::vector<double> nothing(lags.size(), 0.0);
  EXPECT_THROW(fit_sparse(problem.atoms, nothing), std::invalid_argument);
}

}  // namespace
}  // namespace solidnoise::sparse_fit_test

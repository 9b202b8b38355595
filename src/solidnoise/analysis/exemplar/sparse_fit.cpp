#include "solidnoise/analysis/exemplar/sparse_fit.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

#include "solidnoise/core/check.h"

namespace solidnoise {
namespace {

using Coefficients = GaussianAtoms::Coefficients;
using Lags = std::vector<double>;

// Iterations between two looks at the duality gap, which costs half an iteration.
constexpr int kGapInterval = 10;

double largest(const Coefficients& x) {
  double result = -INFINITY;
  for (const std::vector<double>& values : x) {
    for (const double value : values) result = std::max(result, value);
  }
  return result;
}

// Accelerated projected gradient descent for |S x - y|^2 + nu sum x, x >= 0.
class Descent {
 public:
  Descent(const GaussianAtoms& atoms, std::span<const double> target, Coefficients start)
      : atoms_(atoms), target_(target), step_(1.0 / (2.0 * atoms.norm_squared())), x_(std::move(start)) {
    atoms_.synthesize(x_, x_lags_);
    target_energy_ = atoms_.dot(target_, target_);
    restart();
  }

  const Coefficients& x() const { return x_; }

  void restart() {
    y_ = x_;
    y_lags_ = x_lags_;
    momentum_ = 1.0;
  }

  void iterate(double nu) {
    residual_.resize(x_lags_.size());
    for (std::size_t i = 0; i < residual_.size(); ++i) residual_[i] = y_lags_[i] - target_[i];
    atoms_.correlate(residual_, next_);
    double uphill = 0.0;
    for (std::size_t band = 0; band < x_.size(); ++band) {
      const std::span<const double> weights = atoms_.weights(band);
      for (std::size_t i = 0; i < x_[band].size(); ++i) {
        const double gradient = 2.0 * next_[band][i] + nu;
        const double value = std::max(0.0, y_[band][i] - step_ * gradient);
        const double change = value - x_[band][i];
        next_[band][i] = value;
        uphill += weights[i] * (y_[band][i] - value) * change;
      }
    }
    atoms_.synthesize(next_, next_lags_);

    const double next_momentum = 0.5 * (1.0 + std::sqrt(1.0 + 4.0 * momentum_ * momentum_));
    const double push = uphill > 0.0 ? 0.0 : (momentum_ - 1.0) / next_momentum;
    momentum_ = uphill > 0.0 ? 1.0 : next_momentum;
    for (std::size_t band = 0; band < x_.size(); ++band) {
      for (std::size_t i = 0; i < x_[band].size(); ++i) {
        y_[band][i] = next_[band][i] + push * (next_[band][i] - x_[band][i]);
      }
    }
    for (std::size_t i = 0; i < x_lags_.size(); ++i) {
      y_lags_[i] = next_lags_[i] + push * (next_lags_[i] - x_lags_[i]);
    }
    std::swap(x_, next_);
    std::swap(x_lags_, next_lags_);
  }

  // The objective at x and how far it can be from the least one: the residual, scaled, is a feasible point of
  // the dual problem, whose constraint is one-sided as x >= 0.
  void measure(double nu, SparseFit& fit) {
    for (std::size_t i = 0; i < residual_.size(); ++i) residual_[i] = target_[i] - x_lags_[i];
    const double energy = atoms_.dot(residual_, residual_);
    const double along_target = atoms_.dot(residual_, target_);
    atoms_.correlate(residual_, next_);
    const double most = 2.0 * largest(next_);
    double scale = energy > 0.0 ? along_target / energy : 0.0;
    if (most > 0.0) scale = std::min(scale, nu / most);
    scale = std::max(scale, 0.0);
    fit.objective = energy + nu * atoms_.sum(x_);
    fit.gap = fit.objective - (2.0 * scale * along_target - scale * scale * energy);
    fit.residual = std::sqrt(energy / target_energy_);
  }

 private:
  const GaussianAtoms& atoms_;
  std::span<const double> target_;
  double target_energy_ = 0.0;
  double step_;  // 1 / Lipschitz constant of the gradient
  double momentum_ = 1.0;
  Coefficients x_, y_, next_;
  Lags x_lags_, y_lags_, next_lags_, residual_;
};

// kappa = 1/2, 1/4, ... and the one asked for.
std::vector<double> levels_to(double kappa) {
  std::vector<double> result;
  for (double level = 0.5; level > 1.001 * kappa; level *= 0.5) result.push_back(level);
  result.push_back(kappa);
  return result;
}

}  // namespace

void SparseFitOptions::validate() const {
  require_in_range("kappa", kappa, 1e-6, 1.0);
  require_positive("gap_tolerance", gap_tolerance);
  require_at_least("iterations_per_level", iterations_per_level, 1);
}

SparseFit fit_sparse(const GaussianAtoms& atoms, std::span<const double> target_lags,
                     const SparseFitOptions& options, Progress* progress) {
  options.validate();
  SparseFit fit;
  fit.x = atoms.zeros();
  atoms.correlate(target_lags, fit.x);
  fit.nu_max = 2.0 * largest(fit.x);
  if (!(fit.nu_max > 0.0)) throw std::invalid_argument("the spectrum has no power");
  Descent descent(atoms, target_lags, atoms.zeros());

  const std::vector<double> levels = levels_to(options.kappa);
  const auto per_level = static_cast<std::uint64_t>(options.iterations_per_level);
  for (std::size_t level = 0; level < levels.size() && !fit.interrupted; ++level) {
    const double nu = levels[level] * fit.nu_max;
    descent.restart();
    fit.last_iterations = 0;
    while (fit.last_iterations < options.iterations_per_level) {
      descent.iterate(nu);
      ++fit.iterations;
      ++fit.last_iterations;
      if (fit.last_iterations % kGapInterval == 0) {
        descent.measure(nu, fit);
        if (fit.gap <= options.gap_tolerance * fit.objective) break;
      }
      if (progress == nullptr) continue;
      progress->advance(level * per_level + static_cast<std::uint64_t>(fit.last_iterations),
                        levels.size() * per_level);
      if (progress->cancelled()) {
        fit.interrupted = true;
        break;
      }
    }
    descent.measure(nu, fit);
    fit.kappa = levels[level];
  }
  fit.x = descent.x();
  if (fit.interrupted && !(atoms.sum(fit.x) > 0.0)) throw Cancelled();
  return fit;
}

}  // namespace solidnoise

#pragma once

#include <span>

#include "solidnoise/analysis/exemplar/gaussian_atoms.h"
#include "solidnoise/core/progress.h"

namespace solidnoise {

struct SparseFitOptions {
  double kappa = 1.0 / 256.0;      // regularization, relative to where it leaves nothing; above 0, at most 1
  double gap_tolerance = 1e-2;     // where a solution is accepted: duality gap / objective; > 0
  int iterations_per_level = 600;  // at most, of each kappa; >= 1

  // Throws std::invalid_argument.
  void validate() const;
};

struct SparseFit {
  GaussianAtoms::Coefficients x;
  double nu_max = 0.0;      // the regularization from which on x = 0
  double kappa = 1.0;       // reached
  double objective = 0.0;   // |S x - y|^2 + kappa nu_max sum x
  double gap = 0.0;         // the objective is at most this far from the least one
  double residual = 0.0;    // |S x - y| / |y|
  int iterations = 0;       // of all levels
  int last_iterations = 0;  // of the last one
  bool interrupted = false;
};

// Decomposes a spectrum y, given by its transform, into a sparse sum of Gaussians (non-negative basis pursuit
// denoising; Galerne et al. 2012, section 5.2):
//   minimize |S x - y|^2 + nu sum x over x >= 0,   nu = kappa 2 max(S^T y).
// By accelerated projected gradients (FISTA) that restart where the momentum points uphill (O'Donoghue and
// Candes 2015), warm-started along kappa = 1/2, 1/4, ... to the one asked for (the paper uses an interior
// point method). Where `progress` asks to stop, the last solution is returned, which is sound but less sparse
// in detail; Cancelled is thrown if there is none yet. Throws std::invalid_argument for bad options and for a
// spectrum without any power.
SparseFit fit_sparse(const GaussianAtoms& atoms, std::span<const double> target_lags,
                     const SparseFitOptions& options = {}, Progress* progress = nullptr);

}  // namespace solidnoise

#pragma once

namespace solidnoise::papers {

// How the number of impulses is chosen for the two kernels of isotropic noise, cut at a relative error of 2 %
// both (Lagae et al. 2011, sections III-C and IV-B).
enum class Comparison {
  same_density,  // 32 for the isotropic kernel, as many per area for the other: the paper's
  same_number,   // 32 under each kernel
  same_quality,  // as many as bring the excess kurtosis of a Poisson process to 0.5
};

// Nanoseconds of processor time per value, one thread.
struct KernelSpeed {
  double anisotropic_impulses = 0.0;  // mean, under a kernel
  double isotropic_impulses = 0.0;
  // The papers' procedure in single precision, at scattered points.
  double anisotropic_procedure = 0.0;
  double isotropic_procedure = 0.0;
  // The library's blocks, on a lattice; its own weights of 1 or -1, and compact kernels of the same error.
  double anisotropic_block = 0.0;
  double isotropic_block = 0.0;
};

// With the kernels of paper_kernel.h. Dim is 2 to 4; in 4 lattices are frames of 3 dimensions.
template <int Dim>
KernelSpeed measure_kernel_speed(Comparison comparison);

}  // namespace solidnoise::papers

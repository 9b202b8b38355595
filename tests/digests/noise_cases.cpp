#include <array>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "digests/cases.h"
#include "digests/make_recipes.h"
#include "digests/recipe_files.h"
#include "solidnoise/noise/interpolation/interpolated_noise.h"
#include "solidnoise/noise/noise_views.h"
#include "support/evaluated.h"
#include "support/scattered.h"

namespace solidnoise {
namespace {

constexpr double kTime = 0.3;

template <int Dim>
void add(const Evaluated<Dim>& evaluated, Digest& digest) {
  digest.add(std::span<const float>(evaluated.values));
  for (const auto& derivative : evaluated.gradient) digest.add(std::span<const float>(derivative));
}

// Values by themselves, then with their gradients.
template <int Dim, typename Where>
void add_values(const Noise<Dim>& noise, const Where& where, std::size_t count, Digest& digest) {
  Evaluated<Dim> evaluated(count);
  noise.evaluate(where, Samples<Dim>{evaluated.values, {}});
  digest.add(std::span<const float>(evaluated.values));
  noise.evaluate(where, evaluated.samples());
  add(evaluated, digest);
}

// Some kernels wide around 0, of two blocks at least, with a tail for every vector width.
template <int Dim>
void add_lattice(const Noise<Dim>& noise, Digest& digest) {
  constexpr std::array<std::array<int, 4>, 4> kCount{{{4111}, {67, 66}, {35, 9, 34}, {33, 4, 5, 2}}};
  Lattice<Dim> lattice;
  for (int axis = 0; axis < Dim; ++axis) {
    lattice.origin[axis] = 0.013 * axis;
    lattice.step[axis] = 0.11 + 0.02 * axis;
    lattice.count[axis] = kCount[Dim - 1][static_cast<std::size_t>(axis)];
    lattice.first[axis] = -lattice.count[axis] / 2;
  }
  add_values(noise, lattice, lattice.size(), digest);
}

template <int Dim>
void add_points(const Noise<Dim>& noise, Digest& digest) {
  const Scattered<Dim> scattered = scattered_points<Dim>(300, 6.0);
  add_values(noise, scattered.points(), scattered.size(), digest);
}

// On the lattice that it is interpolated for: values want fine ones, and on coarser ones what suits the
// gradient suits the values no more.
template <int Dim>
void add_interpolated(std::shared_ptr<const Noise<Dim>> noise, Quantity quantity, Digest& digest) {
  LatticeFrame<Dim> frame;
  Lattice<Dim> lattice;
  for (int axis = 0; axis < Dim; ++axis) {
    frame.origin[axis] = 0.013 + axis;
    frame.step[axis] = quantity == Quantity::values ? 0.04 : 0.1;
    lattice.first[axis] = -11;
    lattice.count[axis] = Dim == 2 ? 70 : 35;
  }
  lattice.origin = frame.origin;
  lattice.step = frame.step;
  add_values(*interpolate<Dim>(std::move(noise), frame, 0.02, quantity), lattice, lattice.size(), digest);
}

class CaseMaker {
 public:
  DigestCases cases;

  // On a lattice and at points.
  template <int Dim, typename Make>
  void add_both(const std::string& name, const Make& make) {
    add(name + "/lattice", [make](Digest& digest) { add_lattice<Dim>(*make(), digest); });
    add(name + "/points", [make](Digest& digest) { add_points<Dim>(*make(), digest); });
  }

  template <typename Evaluate>
  void add(const std::string& name, const Evaluate& evaluate) {
    cases.push_back({"noise/" + name, evaluate});
  }
};

// The noise itself, and each of its variants.
template <int Dim>
void add_variants(const std::string& name, const Json& kind, const Json& variants, CaseMaker& maker) {
  const std::string begin = name + "/" + std::to_string(Dim) + "d/";
  const Json noise = kind["noise"];
  maker.add_both<Dim>(begin + "plain", [noise] { return noise_of<Dim>(noise); });
  for (const std::string variant : kind["variants"]) {
    Json changed = noise;
    changed.update(variants[variant]);
    const double time = variant == "evolving" ? kTime : 0.0;
    maker.add_both<Dim>(begin + variant, [changed, time] { return noise_of<Dim>(changed, time); });
  }
  if constexpr (Dim > 1) {
    if (noise["type"] != "gabor-oriented") return;
    maker.add_both<Dim>(begin + "quadrature", [noise] { return quadrature_of<Dim>(noise); });
  }
}

template <int Dim>
void add_interpolations(const std::string& name, const Json& noise, CaseMaker& maker) {
  if (noise["type"] == "kensler") return;  // which is not stationary
  for (const auto& [what, quantity] :
       {std::pair("values", Quantity::values), std::pair("gradient", Quantity::gradient)}) {
    maker.add(name + "/" + std::to_string(Dim) + "d/interpolated/" + what,
              [noise, quantity = quantity](Digest& digest) {
                add_interpolated<Dim>(noise_of<Dim>(noise), quantity, digest);
              });
  }
}

// A noise of three dimensions elsewhere, and seen from fewer or more.
void add_views(const std::string& name, const Json& noise, CaseMaker& maker) {
  maker.add_both<3>(name + "/moved", [noise] {
    return move_noise<3>(noise_of<3>(noise), {1.25, -0.4, 1000.3});
  });
  maker.add_both<2>(name + "/plane", [noise] {
    return on_plane(noise_of<3>(noise), {{0.3, 0.1, -0.2}, {0.6, 0.8, 0.0}, {0.0, 0.0, 1.0}});
  });
  maker.add_both<2>(name + "/plane along the axes", [noise] {
    return on_plane(noise_of<3>(noise), {{0.3, 0.1, -0.2}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}});
  });
  if (noise["type"] == "spectrum") return;
  maker.add_both<3>(name + "/slice", [noise] { return slice(noise_of<4>(noise), kTime); });
}

}  // namespace

DigestCases noise_cases() {
  const Json file = read_json("tests/digests/noises.json");
  const Json& variants = file["variants"];
  CaseMaker maker;
  for (const auto& [name, kind] : file["kinds"].items()) {
    const std::vector<int> dimensions = kind.value("dimensions", std::vector{1, 2, 3, 4});
    for (const int dim : dimensions) {
      if (dim == 1) add_variants<1>(name, kind, variants, maker);
      if (dim == 2) add_variants<2>(name, kind, variants, maker);
      if (dim == 2) add_interpolations<2>(name, kind["noise"], maker);
      if (dim == 3) add_variants<3>(name, kind, variants, maker);
      if (dim == 3) add_interpolations<3>(name, kind["noise"], maker);
      if (dim == 3) add_views(name, kind["noise"], maker);
      if (dim == 4) add_variants<4>(name, kind, variants, maker);
    }
  }
  return std::move(maker.cases);
}

}  // namespace solidnoise

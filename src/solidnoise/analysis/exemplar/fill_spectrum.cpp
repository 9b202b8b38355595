#include "solidnoise/analysis/exemplar/fill_spectrum.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

#include <tbb/parallel_for.h>

#include "solidnoise/analysis/exemplar/gaussian_field.h"

namespace solidnoise {
namespace {

constexpr int kRounds = 10;
constexpr int kPrunings = 4;       // each after so many rounds
constexpr double kEvidence = 1.0;  // that a Gaussian must bring (Akaike 1974)

// A Gaussian on the periodic grid of frequencies, along one axis: from `first` on.
struct Row {
  int first = 0;
  std::vector<double> values;
};

// A Gaussian of sum 1 over the frequencies, and the component that it and its mirror image are.
struct Atom {
  double a = 0.0;
  SpectrumComponent component{};
  Row rows[2];
};

Row make_row(double a, double frequency, double step) {
  constexpr double kFarthest = 3.5;  // standard deviations
  const double reach = kFarthest * a / std::sqrt(4.0 * std::numbers::pi);
  Row row{static_cast<int>(std::ceil((frequency - reach) / step)), {}};
  double sum = 0.0;
  for (int i = row.first; i * step <= frequency + reach; ++i) {
    const double d = (i * step - frequency) / a;
    row.values.push_back(std::exp(-2.0 * std::numbers::pi * d * d));
    sum += row.values.back();
  }
  for (double& value : row.values) value /= sum;
  return row;
}

std::size_t wrapped(int index, int count) {
  return static_cast<std::size_t>(((index % count) + count) % count);
}

// Calls visit(frequency, its Gaussian's value) for those under an atom, or under its mirror image.
template <typename Visit>
void for_each_under(const Atom& atom, const glm::ivec2& count, bool mirrored, const Visit& visit) {
  const auto place = [&](int axis, std::size_t i) {
    const int index = atom.rows[axis].first + static_cast<int>(i);
    return wrapped(mirrored ? -index : index, count[axis]);
  };
  for (std::size_t i = 0; i < atom.rows[0].values.size(); ++i) {
    const std::size_t row = place(0, i) * static_cast<std::size_t>(count.y);
    for (std::size_t k = 0; k < atom.rows[1].values.size(); ++k) {
      visit(row + place(1, k), atom.rows[0].values[i] * atom.rows[1].values[k]);
    }
  }
}

// The octaves' Gaussians, down from the highest frequency of the samples and its corners.
std::vector<Atom> make_atoms(const PowerSpectrum<2>& periodogram) {
  const Vec<2> step(periodogram.frequency_step(0), periodogram.frequency_step(1));
  const double highest = 1.0 / (periodogram.step[0] + periodogram.step[1]);
  std::vector<Atom> atoms;
  for (double top = highest;; top *= 0.5) {
    const double width = 0.25 * top;  // full, at half of the maximum
    if (width < 2.0 * std::max(step.x, step.y)) return atoms;
    const double a = width * std::sqrt(std::numbers::pi / (2.0 * std::numbers::ln2));
    const double spacing = 0.5 * width;
    const double end = top == highest ? 2.0 * highest : top;
    const int most = static_cast<int>(std::ceil(end / spacing));
    for (int i = 0; i <= most; ++i) {
      for (int k = -most; k <= most; ++k) {
        const Vec<2> f = spacing * Vec<2>(i, k);
        const double length = std::hypot(f.x, f.y);
        const bool is_inside =
            std::abs(f.x) * periodogram.step[0] <= 0.5 && std::abs(f.y) * periodogram.step[1] <= 0.5;
        if (!is_inside || length < 0.5 * top || length >= end || (i == 0 && k < 0)) continue;
        Atom& atom = atoms.emplace_back();
        atom.a = a;
        atom.component.frequency = {f.x, f.y, 0.0};
        for (int axis = 0; axis < 2; ++axis) atom.rows[axis] = make_row(a, f[axis], step[axis]);
      }
    }
  }
}

int group_for(GaborSpectrum& spectrum) {
  if (spectrum.groups.empty()) spectrum.groups.emplace_back("all");
  return 0;
}

void add(GaborSpectrum& spectrum, double a, const SpectrumComponent& component) {
  constexpr double kSame = 1e-9;
  for (SpectrumBand& band : spectrum.bands) {
    if (std::abs(band.a - a) > kSame * a) continue;
    band.components.push_back(component);
    return;
  }
  spectrum.bands.push_back({a, {component}});
}

}  // namespace

void fill_spectrum(GaborSpectrum& spectrum, const PowerSpectrum<2>& periodogram) {
  const glm::ivec2 count = periodogram.count;
  const std::vector<double> sparse = sampled_density<2>(spectrum, count, periodogram.step).density;
  const double cell = periodogram.cell();
  std::vector<Atom> atoms = make_atoms(periodogram);

  // Begin with a part of what is there.
  constexpr double kBegin = 0.1;
  constexpr double kFloor = 1e-12;  // of the mean density: where there is nothing
  double mean = 0.0;
  for (const double density : periodogram.density)
    mean += std::abs(density) / static_cast<double>(count.x * count.y);
  tbb::parallel_for(std::size_t{0}, atoms.size(), [&](std::size_t k) {
    double density = 0.0;
    for_each_under(atoms[k], count, false,
                   [&](std::size_t i, double g) { density += g * periodogram.density[i]; });
    atoms[k].component.variance = kBegin * std::max(density, 0.0) * 0.5 * atoms[k].a * atoms[k].a;
  });

  std::vector<double> density;
  const auto synthesize = [&] {
    density = sparse;
    for (double& value : density) value += kFloor * mean;
    for (const Atom& atom : atoms) {
      const double scale = 0.5 * atom.component.variance / cell;
      for (const bool mirrored : {false, true}) {
        for_each_under(atom, count, mirrored, [&](std::size_t i, double g) { density[i] += scale * g; });
      }
    }
  };
  const auto improve = [&] {
    synthesize();
    for (std::size_t i = 0; i < density.size(); ++i) density[i] = periodogram.density[i] / density[i];
    tbb::parallel_for(std::size_t{0}, atoms.size(), [&](std::size_t k) {
      double ratio = 0.0;
      for_each_under(atoms[k], count, false, [&](std::size_t i, double g) { ratio += g * density[i]; });
      atoms[k].component.variance *= std::max(ratio, 0.0);
    });
  };
  // By how much the likelihood's logarithm falls without an atom, to second order.
  const auto evidence = [&](const Atom& atom) {
    const double scale = 0.5 * atom.component.variance / cell;
    double sum = 0.0;
    for_each_under(atom, count, false, [&](std::size_t i, double g) {
      const double share = scale * g / density[i];
      sum += 0.5 * share * share;
    });
    return sum;
  };
  for (int pruning = 1; pruning <= kPrunings; ++pruning) {
    for (int round = 0; round < kRounds; ++round) improve();
    synthesize();
    // Little by little, as those that stay take over what the others had.
    const double least = kEvidence * pruning / kPrunings;
    std::erase_if(atoms, [&](const Atom& atom) { return evidence(atom) < least; });
  }
  for (int round = 0; round < kRounds; ++round) improve();

  const int group = group_for(spectrum);
  for (Atom& atom : atoms) {
    atom.component.group = group;
    add(spectrum, atom.a, atom.component);
  }
}

}  // namespace solidnoise

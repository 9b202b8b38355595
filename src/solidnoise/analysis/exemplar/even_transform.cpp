#include "solidnoise/analysis/exemplar/even_transform.h"

#include <algorithm>
#include <complex>
#include <stdexcept>
#include <vector>

#include <fmt/format.h>
#include <kissfft/kissfft.hh>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

namespace solidnoise {
namespace {

using Complex = std::complex<double>;
using Plan = kissfft<double>;

// Lines that are gathered together, so that each cache line that is read serves all of them; two real lines
// are one complex transform.
constexpr std::size_t kLines = 8;
// Transforms below this many elements are not worth sharing among threads.
constexpr std::size_t kParallelElements = 1 << 14;

// A plan, for each thread its own: where a length has factors above 5 it writes to itself.
using ThreadPlans = tbb::enumerable_thread_specific<Plan>;

// All lines along one axis of an array: the elements `index % inner + index / inner * inner * length`, with
// `inner` apart.
struct Lines {
  std::size_t length = 1;
  std::size_t inner = 1;  // product of the counts of the faster axes
  std::size_t outer = 1;

  Lines(const Counts3& counts, std::size_t axis) : length(static_cast<std::size_t>(counts[axis])) {
    for (std::size_t i = 0; i < counts.size(); ++i) {
      const auto count = static_cast<std::size_t>(counts[i]);
      if (i < axis) outer *= count;
      if (i > axis) inner *= count;
    }
  }

  std::size_t count() const { return inner * outer; }
  std::size_t first(std::size_t line) const { return line / inner * inner * length + line % inner; }
};

template <typename Body>
void for_line_blocks(const Lines& lines, const Body& body) {
  const std::size_t blocks = (lines.count() + kLines - 1) / kLines;
  const auto run = [&](std::size_t block) {
    body(block * kLines, std::min(kLines, lines.count() - block * kLines));
  };
  if (lines.count() * lines.length < kParallelElements) {
    for (std::size_t block = 0; block < blocks; ++block) run(block);
  } else {
    tbb::parallel_for(std::size_t(0), blocks, run);
  }
}

// Real lines into the first half of their coefficients. With z = a + i b, A_k = (Z_k + conj Z_-k) / 2 and
// B_k = (Z_k - conj Z_-k) / 2i.
void real_to_half(const Plan& of_all, const Lines& in, const Lines& out, const double* values,
                  Complex* coefficients) {
  ThreadPlans plans(of_all);
  for_line_blocks(in, [&](std::size_t first_line, std::size_t lines) {
    const Plan& plan = plans.local();
    const std::size_t n = in.length;
    std::vector<Complex> gathered(kLines / 2 * n);
    std::vector<Complex> transformed(kLines / 2 * n);
    for (std::size_t line = 0; line < lines; ++line) {
      const double* const from = values + in.first(first_line + line);
      double* const to = reinterpret_cast<double*>(&gathered[line / 2 * n]) + line % 2;
      for (std::size_t i = 0; i < n; ++i) to[2 * i] = from[i * in.inner];
    }
    for (std::size_t pair = 0; 2 * pair < lines; ++pair) {
      const Complex* const z = &transformed[pair * n];
      plan.transform(&gathered[pair * n], &transformed[pair * n]);
      const bool has_second = 2 * pair + 1 < lines;
      Complex* const a = coefficients + out.first(first_line + 2 * pair);
      Complex* const b = has_second ? coefficients + out.first(first_line + 2 * pair + 1) : nullptr;
      for (std::size_t k = 0; k < out.length; ++k) {
        const Complex mirrored = std::conj(z[k == 0 ? 0 : n - k]);
        a[k * out.inner] = 0.5 * (z[k] + mirrored);
        if (has_second) {
          const Complex difference = z[k] - mirrored;
          b[k * out.inner] = Complex(0.5 * difference.imag(), -0.5 * difference.real());
        }
      }
    }
  });
}

// Lines with X_-k = conj X_k, of which one half is given, into real lines: of Z = A + i B the transform has
// A's in its real part and B's in its imaginary part.
void half_to_real(const Plan& of_all, const Lines& in, const Lines& out, const Complex* coefficients,
                  double* values) {
  ThreadPlans plans(of_all);
  for_line_blocks(out, [&](std::size_t first_line, std::size_t lines) {
    const Plan& plan = plans.local();
    const std::size_t n = out.length;
    std::vector<Complex> gathered(n);
    std::vector<Complex> transformed(n);
    for (std::size_t line = 0; line < lines; line += 2) {
      const bool has_second = line + 1 < lines;
      const Complex* const a = coefficients + in.first(first_line + line);
      const Complex* const b = has_second ? coefficients + in.first(first_line + line + 1) : nullptr;
      for (std::size_t k = 0; k < in.length; ++k) {
        const Complex at_a = a[k * in.inner];
        const Complex at_b = has_second ? b[k * in.inner] : Complex(0.0);
        gathered[k] = Complex(at_a.real() - at_b.imag(), at_a.imag() + at_b.real());
        if (k > 0) gathered[n - k] = Complex(at_a.real() + at_b.imag(), at_b.real() - at_a.imag());
      }
      plan.transform(gathered.data(), transformed.data());
      double* const to = values + out.first(first_line + line);
      double* const second = has_second ? values + out.first(first_line + line + 1) : nullptr;
      for (std::size_t i = 0; i < n; ++i) to[i * out.inner] = transformed[i].real();
      if (has_second) {
        for (std::size_t i = 0; i < n; ++i) second[i * out.inner] = transformed[i].imag();
      }
    }
  });
}

void transform_lines(const Plan& of_all, const Lines& lines, Complex* data) {
  if (lines.length == 1) return;
  ThreadPlans plans(of_all);
  for_line_blocks(lines, [&](std::size_t first_line, std::size_t count) {
    const Plan& plan = plans.local();
    std::vector<Complex> gathered(lines.length);
    std::vector<Complex> transformed(lines.length);
    for (std::size_t line = 0; line < count; ++line) {
      Complex* const base = data + lines.first(first_line + line);
      for (std::size_t i = 0; i < lines.length; ++i) gathered[i] = base[i * lines.inner];
      plan.transform(gathered.data(), transformed.data());
      for (std::size_t i = 0; i < lines.length; ++i) base[i * lines.inner] = transformed[i];
    }
  });
}

Counts3 halved(Counts3 counts, std::size_t axis) {
  counts[axis] = counts[axis] / 2 + 1;
  return counts;
}

}  // namespace

Counts3 half_counts(const Counts3& counts, HalfAxis half) {
  return halved(counts, half == HalfAxis::first ? 0 : 2);
}

std::size_t element_count(const Counts3& counts) {
  std::size_t result = 1;
  for (const int count : counts) result *= static_cast<std::size_t>(count);
  return result;
}

struct EvenTransform::Plans {
  Plan first;
  Plan middle;
  Plan last;

  explicit Plans(const Counts3& counts)
      : first(static_cast<std::size_t>(counts[0]), false),
        middle(static_cast<std::size_t>(counts[1]), false),
        last(static_cast<std::size_t>(counts[2]), false) {}
};

EvenTransform::EvenTransform(const Counts3& counts) : counts_(counts) {
  for (const int count : counts) {
    if (count < 1) throw std::invalid_argument(fmt::format("FFT count is {}; it must be at least 1", count));
  }
  plans_ = std::make_unique<const Plans>(counts);
}

EvenTransform::~EvenTransform() = default;
EvenTransform::EvenTransform(EvenTransform&&) noexcept = default;

// A real even array is transformed along the axis that is stored whole, which leaves lines along the other
// one that are the conjugate of their mirror image.
void EvenTransform::to_lags(std::span<const double> frequencies, std::span<double> lags) const {
  const Counts3 both = halved(half_counts(counts_, HalfAxis::last), 0);
  std::vector<Complex> between(element_count(both));
  real_to_half(plans_->first, Lines(half_counts(counts_, HalfAxis::last), 0), Lines(both, 0),
               frequencies.data(), between.data());
  transform_lines(plans_->middle, Lines(both, 1), between.data());
  half_to_real(plans_->last, Lines(both, 2), Lines(half_counts(counts_, HalfAxis::first), 2), between.data(),
               lags.data());
}

void EvenTransform::to_frequencies(std::span<const double> lags, std::span<double> frequencies) const {
  const Counts3 both = halved(half_counts(counts_, HalfAxis::last), 0);
  std::vector<Complex> between(element_count(both));
  real_to_half(plans_->last, Lines(half_counts(counts_, HalfAxis::first), 2), Lines(both, 2), lags.data(),
               between.data());
  transform_lines(plans_->middle, Lines(both, 1), between.data());
  half_to_real(plans_->first, Lines(both, 0), Lines(half_counts(counts_, HalfAxis::last), 0), between.data(),
               frequencies.data());
}

}  // namespace solidnoise

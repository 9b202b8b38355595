#include "solidnoise/noise/gradient/gradient_lattice.h"

#include <cmath>
#include <cstddef>
#include <numbers>
#include <numeric>
#include <utility>

#include "solidnoise/core/random.h"

namespace solidnoise {
namespace {

// Keys of the independent streams of a seed. Part of the noise's definition.
constexpr std::uint64_t kGradientStream = 1;
constexpr std::uint64_t kHashStream = 2;
constexpr std::uint64_t kPermutationStream = 3;  // and the following, one per axis

// Fisher-Yates.
template <typename T, std::size_t Count>
void shuffle(std::array<T, Count>& items, RandomStream& random) {
  for (std::size_t i = Count - 1; i > 0; --i) {
    const double choice = random.next_unit();
    std::swap(items[i], items[static_cast<std::size_t>(choice * static_cast<double>(i + 1))]);
  }
}

using Quaternion = std::array<double, 4>;  // x, y, z, w

// Uniform on the unit sphere in four dimensions (Shoemake 1992).
Quaternion random_quaternion(RandomStream& random) {
  const double split = random.next_unit();
  const double angle1 = 2.0 * std::numbers::pi * random.next_unit();
  const double angle2 = 2.0 * std::numbers::pi * random.next_unit();
  const double r1 = std::sqrt(1.0 - split);
  const double r2 = std::sqrt(split);
  return {r1 * std::sin(angle1), r1 * std::cos(angle1), r2 * std::sin(angle2), r2 * std::cos(angle2)};
}

Quaternion multiply(const Quaternion& a, const Quaternion& b) {
  return {a[3] * b[0] + a[0] * b[3] + a[1] * b[2] - a[2] * b[1],
          a[3] * b[1] - a[0] * b[2] + a[1] * b[3] + a[2] * b[0],
          a[3] * b[2] + a[0] * b[1] - a[1] * b[0] + a[2] * b[3],
          a[3] * b[3] - a[0] * b[0] - a[1] * b[1] - a[2] * b[2]};
}

// The vertices of one randomly rotated regular polytope with mean 0 and mean of g g^T equal to I/n.
struct Design {
  static std::array<Vec<1>, 2> make(RandomStream&, Vec<1>) { return {Vec<1>(1.0), Vec<1>(-1.0)}; }

  static std::array<Vec<2>, 4> make(RandomStream& random, Vec<2>) {
    const double angle = 2.0 * std::numbers::pi * random.next_unit();
    const double c = std::cos(angle);
    const double s = std::sin(angle);
    return {Vec<2>(c, s), Vec<2>(-s, c), Vec<2>(-c, -s), Vec<2>(s, -c)};
  }

  static std::array<Vec<3>, 8> make(RandomStream& random, Vec<3>) {
    const Quaternion q = random_quaternion(random);
    const Quaternion inverse = {-q[0], -q[1], -q[2], q[3]};
    const double half_edge = 1.0 / std::sqrt(3.0);
    std::array<Vec<3>, 8> corners;
    for (int corner = 0; corner < 8; ++corner) {
      const Quaternion cube = {corner & 1 ? half_edge : -half_edge, corner & 2 ? half_edge : -half_edge,
                               corner & 4 ? half_edge : -half_edge, 0.0};
      const Quaternion rotated = multiply(multiply(q, cube), inverse);
      corners[static_cast<std::size_t>(corner)] = Vec<3>(rotated[0], rotated[1], rotated[2]);
    }
    return corners;
  }

  // Every rotation in four dimensions is x -> p x q for two unit quaternions.
  static std::array<Vec<4>, 8> make(RandomStream& random, Vec<4>) {
    const Quaternion left = random_quaternion(random);
    const Quaternion right = random_quaternion(random);
    std::array<Vec<4>, 8> vertices;
    for (std::size_t axis = 0; axis < 4; ++axis) {
      Quaternion unit = {0.0, 0.0, 0.0, 0.0};
      unit[axis] = 1.0;
      const Quaternion rotated = multiply(multiply(left, unit), right);
      vertices[2 * axis] = Vec<4>(rotated[0], rotated[1], rotated[2], rotated[3]);
      vertices[2 * axis + 1] = -vertices[2 * axis];
    }
    return vertices;
  }
};

}  // namespace

std::uint64_t gradient_hash_key(std::uint64_t seed) {
  return derive_seed(seed, kHashStream);
}

template <int Dim>
std::array<Vec<Dim>, kGradients> make_gradients(std::uint64_t seed) {
  RandomStream random(derive_seed(seed, kGradientStream));
  std::array<Vec<Dim>, kGradients> gradients;
  std::size_t filled = 0;
  while (filled < gradients.size()) {
    for (const Vec<Dim>& direction : Design::make(random, Vec<Dim>(0.0))) gradients[filled++] = direction;
  }
  shuffle(gradients, random);
  return gradients;
}

template <int Dim>
std::array<std::array<std::uint8_t, 256>, Dim> make_permutations(std::uint64_t seed) {
  std::array<std::array<std::uint8_t, 256>, Dim> permutations;
  for (std::size_t axis = 0; axis < Dim; ++axis) {
    RandomStream random(derive_seed(seed, kPermutationStream + axis));
    std::iota(permutations[axis].begin(), permutations[axis].end(), std::uint8_t{0});
    shuffle(permutations[axis], random);
  }
  return permutations;
}

template <int Dim>
GradientLattice<Dim>::GradientLattice(const GradientNoiseOptions& options,
                                      const std::array<CellAxis, Dim>& axes)
    : axes_(axes),
      hash_(options.hash),
      steps_(options.support == GradientNoiseOptions::Support::half ? 2 : 1),
      hash_key_(gradient_hash_key(options.seed)),
      permutations_(make_permutations<Dim>(options.seed)),
      gradients_(make_gradients<Dim>(options.seed)) {}

template <int Dim>
std::uint64_t GradientLattice<Dim>::first_hash() const {
  return hash_ == GradientNoiseOptions::Hash::integer ? hash_key_ : 0;
}

template <int Dim>
std::uint64_t GradientLattice<Dim>::extend_hash(std::uint64_t hash, int axis, std::int64_t cell) const {
  const std::size_t a = static_cast<std::size_t>(axis);
  const std::int64_t coordinate = axes_[a].wrap(cell) * steps_;
  if (hash_ == GradientNoiseOptions::Hash::integer) return hash_coordinate(hash, coordinate);
  return hash ^ permutations_[a][static_cast<std::uint64_t>(coordinate) & 255u];
}

template <int Dim>
std::uint8_t GradientLattice<Dim>::gradient_index(const Index<Dim>& cell) const {
  std::uint64_t hash = first_hash();
  for (int axis = 0; axis < Dim; ++axis) hash = extend_hash(hash, axis, cell[axis]);
  return static_cast<std::uint8_t>(hash & 255u);
}

template <int Dim>
void GradientLattice<Dim>::gradient_indices(const CellBox<Dim>& box, std::uint8_t* indices) const {
  fill_from_axis(0, first_hash(), box, indices);
}

template <int Dim>
void GradientLattice<Dim>::fill_from_axis(int axis, std::uint64_t hash, const CellBox<Dim>& box,
                                          std::uint8_t*& next) const {
  for (std::int64_t k = 0; k < box.count[axis]; ++k) {
    const std::uint64_t extended = extend_hash(hash, axis, box.first[axis] + k);
    if (axis + 1 < Dim) {
      fill_from_axis(axis + 1, extended, box, next);
    } else {
      *next++ = static_cast<std::uint8_t>(extended & 255u);
    }
  }
}

template std::array<Vec<1>, kGradients> make_gradients<1>(std::uint64_t);
template std::array<Vec<2>, kGradients> make_gradients<2>(std::uint64_t);
template std::array<Vec<3>, kGradients> make_gradients<3>(std::uint64_t);
template std::array<Vec<4>, kGradients> make_gradients<4>(std::uint64_t);
template std::array<std::array<std::uint8_t, 256>, 1> make_permutations<1>(std::uint64_t);
template std::array<std::array<std::uint8_t, 256>, 2> make_permutations<2>(std::uint64_t);
template std::array<std::array<std::uint8_t, 256>, 3> make_permutations<3>(std::uint64_t);
template std::array<std::array<std::uint8_t, 256>, 4> make_permutations<4>(std::uint64_t);

template class GradientLattice<1>;
template class GradientLattice<2>;
template class GradientLattice<3>;
template class GradientLattice<4>;

}  // namespace solidnoise

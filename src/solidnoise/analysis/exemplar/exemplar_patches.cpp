#include "solidnoise/analysis/exemplar/exemplar_patches.h"

namespace solidnoise {
namespace {

bool is_fast(int count) {
  if (count % 2 != 0) return false;
  for (const int prime : {2, 3, 5, 7}) {
    while (count % prime == 0) count /= prime;
  }
  return count == 1;
}

// Where patches begin along an axis.
std::vector<int> patch_starts(int count, int patch) {
  const int patches = 1 + 2 * (count - patch) / patch;
  std::vector<int> starts;
  for (int i = 0; i < patches; ++i) {
    starts.push_back(patches == 1 ? (count - patch) / 2 : i * (count - patch) / (patches - 1));
  }
  return starts;
}

}  // namespace

int fast_count(int count) {
  while (count > kSmallestPatch && !is_fast(count)) --count;
  return count;
}

template <int Dim>
std::vector<glm::vec<Dim, int>> patch_origins(const Exemplar<Dim>& exemplar,
                                              const glm::vec<Dim, int>& count) {
  std::vector<int> starts[Dim];
  glm::vec<Dim, int> patches(1);
  for (int axis = 0; axis < Dim; ++axis) {
    starts[axis] = patch_starts(exemplar.shape().count[axis], count[axis]);
    patches[axis] = static_cast<int>(starts[axis].size());
  }
  const ArrayShape<Dim> shape{patches};
  std::vector<glm::vec<Dim, int>> origins(shape.size());
  for (std::size_t i = 0; i < origins.size(); ++i) {
    const glm::vec<Dim, int> at = shape.position(i);
    for (int axis = 0; axis < Dim; ++axis)
      origins[i][axis] = starts[axis][static_cast<std::size_t>(at[axis])];
  }
  return origins;
}

template <int Dim>
DenseField<Dim> cut_patch(const DenseField<Dim>& field, const glm::vec<Dim, int>& origin,
                          const glm::vec<Dim, int>& count) {
  DenseField<Dim> result(count, field.step);
  const ArrayShape<Dim> from{field.count};
  const ArrayShape<Dim> to{count};
  for (std::size_t i = 0; i < result.values.size(); ++i) {
    result.values[i] = field.values[from.index(to.position(i) + origin)];
  }
  return result;
}

template std::vector<glm::ivec2> patch_origins<2>(const Exemplar<2>&, const glm::ivec2&);
template std::vector<glm::ivec3> patch_origins<3>(const Exemplar<3>&, const glm::ivec3&);
template DenseField<2> cut_patch<2>(const DenseField<2>&, const glm::ivec2&, const glm::ivec2&);
template DenseField<3> cut_patch<3>(const DenseField<3>&, const glm::ivec3&, const glm::ivec3&);

}  // namespace solidnoise

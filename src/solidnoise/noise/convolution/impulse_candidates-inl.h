// Positions of impulses, for one instruction set. Included once per target; see impulse_candidates_simd.cpp.
#include <cstddef>
#include <cstdint>

#include <hwy/highway.h>

#include "solidnoise/core/cell_grid.h"
#include "solidnoise/core/random.h"
#include "solidnoise/noise/convolution/impulse_candidates.h"
#include "solidnoise/noise/convolution/impulse_cull-inl.h"

#if defined(SOLIDNOISE_IMPULSE_CANDIDATES_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef SOLIDNOISE_IMPULSE_CANDIDATES_INL
#undef SOLIDNOISE_IMPULSE_CANDIDATES_INL
#else
#define SOLIDNOISE_IMPULSE_CANDIDATES_INL
#endif

HWY_BEFORE_NAMESPACE();
namespace solidnoise {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// mix_bits() of each lane.
template <class D, class V = hn::Vec<D>>
HWY_INLINE V MixBits(D d, V z) {
  z = hn::Mul(hn::Xor(z, hn::ShiftRight<30>(z)), hn::Set(d, kMixFactors[0]));
  z = hn::Mul(hn::Xor(z, hn::ShiftRight<27>(z)), hn::Set(d, kMixFactors[1]));
  return hn::Xor(z, hn::ShiftRight<31>(z));
}

// As ImpulseProcess::position(): a number of the stream for each two axes.
inline std::uint64_t PlaceCandidates(const CandidateBox& box, ImpulseCandidates& candidates) {
  const hn::CappedTag<std::uint64_t, 8> d;
  const hn::Rebind<std::int32_t, decltype(d)> di;
  const hn::RebindToUnsigned<decltype(di)> du;
  const hn::Rebind<float, decltype(d)> df;
  using V = hn::Vec<decltype(d)>;
  using VI = hn::Vec<decltype(di)>;
  using VF = hn::Vec<decltype(df)>;
  const int bits = CellAxis::kFractionBits - box.halvings;  // of a place in its piece
  const VF in_cells = hn::Set(df, 1.0f / (1 << CellAxis::kFractionBits));
  std::uint64_t reaching = 0;
  for (std::size_t i = 0; i < candidates.count; i += hn::Lanes(d)) {
    V state = hn::LoadU(d, candidates.key.data() + i);
    if (box.mixes_keys) {
      state = MixBits(d, state);
      hn::StoreU(state, d, candidates.key.data() + i);
    }
    // The mirror image of a place has all of its bits inverted.
    const VI number = hn::BitCast(di, hn::LoadU(du, candidates.number.data() + i));
    const VI image = hn::VecFromMask(di, hn::Gt(number, hn::Set(di, box.places - 1)));
    const VI inverted = hn::And(image, hn::Set(di, (1 << bits) - 1));
    V uniform = state;
    VF distance = hn::Zero(df);
    for (int axis = 0; axis < box.dimensions; ++axis) {
      const auto a = static_cast<std::size_t>(axis);
      if (axis % 2 == 0) {
        state = hn::Add(state, hn::Set(d, kGoldenGamma));
        uniform = MixBits(d, state);
      } else {
        uniform = hn::ShiftLeft<32>(uniform);
      }
      std::int32_t* const position = candidates.position[a].data() + i;
      const VI drawn = hn::BitCast(di, hn::TruncateTo(du, hn::ShiftRightSame(uniform, 64 - bits)));
      const VI place = hn::Xor(drawn, inverted);
      VI at = hn::Add(hn::LoadU(di, position), place);
      if (box.halvings > 0) {
        const VI piece = hn::BitCast(di, hn::LoadU(du, candidates.piece.data() + i));
        const VI corner =
            hn::And(hn::ShiftRightSame(piece, axis * box.halvings), hn::Set(di, (1 << box.halvings) - 1));
        at = hn::Add(at, hn::ShiftLeftSame(corner, bits));
      }
      hn::StoreU(at, di, position);
      const VF x = hn::Mul(hn::ConvertTo(df, at), in_cells);
      const VF radii = Excess(df, x, box.lower[axis], box.upper[axis], box.scale[axis]);
      distance = box.is_ball ? hn::MulAdd(radii, radii, distance) : hn::Max(distance, hn::Mul(radii, radii));
    }
    std::uint8_t bytes[8] = {};
    hn::StoreMaskBits(df, hn::Le(distance, hn::Set(df, box.most)), bytes);
    reaching |= static_cast<std::uint64_t>(bytes[0]) << i;
  }
  return candidates.count < 64 ? reaching & ((std::uint64_t{1} << candidates.count) - 1) : reaching;
}

}  // namespace HWY_NAMESPACE
}  // namespace solidnoise
HWY_AFTER_NAMESPACE();

#endif  // SOLIDNOISE_IMPULSE_CANDIDATES_INL

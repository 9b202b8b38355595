// Sine and cosine in cycles, for one instruction set. Included once per target; see impulse_sums_simd.cpp.
#include <hwy/highway.h>

#if defined(SOLIDNOISE_COSINE_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef SOLIDNOISE_COSINE_INL
#undef SOLIDNOISE_COSINE_INL
#else
#define SOLIDNOISE_COSINE_INL
#endif

HWY_BEFORE_NAMESPACE();
namespace solidnoise {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// cos(2 pi r) and sin(2 pi r). The argument is reduced to a quarter cycle around the nearest half cycle;
// there the polynomials are Chebyshev fits in r^2 on [0, 1/16] with an error below 2.5e-7. Range: |r| < 2^20.
template <class D, class V = hn::Vec<D>>
HWY_INLINE void CosineSine(D d, V r, V& cosine, V& sine) {
  const hn::RebindToSigned<D> di;
  // Adding 3 * 2^22 rounds to a whole number, whose parity is then the lowest bit.
  const V shift = hn::Set(d, 12582912.0f);
  const V shifted = hn::MulAdd(r, hn::Set(d, 2.0f), shift);
  const V half_cycles = hn::Sub(shifted, shift);
  const V reduced = hn::NegMulAdd(half_cycles, hn::Set(d, 0.5f), r);
  const V square = hn::Mul(reduced, reduced);

  V c = hn::Set(d, 56.24054045f);
  c = hn::MulAdd(c, square, hn::Set(d, -85.24010036f));
  c = hn::MulAdd(c, square, hn::Set(d, 64.93458165f));
  c = hn::MulAdd(c, square, hn::Set(d, -19.73917132f));
  c = hn::MulAdd(c, square, hn::Set(d, 0.99999995f));

  V s = hn::Set(d, 39.76072212f);
  s = hn::MulAdd(s, square, hn::Set(d, -76.58128456f));
  s = hn::MulAdd(s, square, hn::Set(d, 81.60248074f));
  s = hn::MulAdd(s, square, hn::Set(d, -41.34168067f));
  s = hn::MulAdd(s, square, hn::Set(d, 6.28318528f));
  s = hn::Mul(s, reduced);

  // An odd number of half cycles turns both signs.
  const V sign = hn::BitCast(d, hn::ShiftLeft<31>(hn::BitCast(di, shifted)));
  cosine = hn::Xor(c, sign);
  sine = hn::Xor(s, sign);
}

}  // namespace HWY_NAMESPACE
}  // namespace solidnoise
HWY_AFTER_NAMESPACE();

#endif  // SOLIDNOISE_COSINE_INL

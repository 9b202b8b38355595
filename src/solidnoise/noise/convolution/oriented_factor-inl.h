// The factors of an oriented kernel, for one instruction set. Included once per target; see
// impulse_sums_simd.cpp.
#include <numbers>

#include <hwy/highway.h>

#include "solidnoise/noise/convolution/cosine-inl.h"
#include "solidnoise/noise/convolution/impulse_sums.h"
#include "solidnoise/noise/convolution/polynomial-inl.h"

#if defined(SOLIDNOISE_ORIENTED_FACTOR_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef SOLIDNOISE_ORIENTED_FACTOR_INL
#undef SOLIDNOISE_ORIENTED_FACTOR_INL
#else
#define SOLIDNOISE_ORIENTED_FACTOR_INL
#endif

HWY_BEFORE_NAMESPACE();
namespace solidnoise {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

template <class V>
struct Complex {
  V re, im;
};

template <class V>
HWY_INLINE Complex<V> Multiply(const Complex<V>& a, const Complex<V>& b) {
  return {hn::NegMulAdd(a.im, b.im, hn::Mul(a.re, b.re)), hn::MulAdd(a.im, b.re, hn::Mul(a.re, b.im))};
}

// sum + Re(a b)
template <class V>
HWY_INLINE V AddRealProduct(const Complex<V>& a, const Complex<V>& b, V sum) {
  return hn::NegMulAdd(a.im, b.im, hn::MulAdd(a.re, b.re, sum));
}

// One axis' factor of a kernel and its derivative by the offset in half-widths.
template <class V>
struct AxisFactor {
  Complex<V> value;
  Complex<V> derivative;
};

// `offset` from the impulse in cells, `wave` in cycles per cell, `phase` in cycles; `weight` is a factor of
// it.
template <Derivatives kDerivatives, class D, class Envelope, class V = hn::Vec<D>>
HWY_INLINE AxisFactor<V> FactorAlongAxis(D d, const Envelope& envelope, V offset, V wave, V phase, V weight,
                                         float scale) {
  const V scaled = hn::Mul(offset, hn::Set(d, scale));
  const V t = PositivePart(d, hn::NegMulAdd(scaled, scaled, hn::Set(d, 1.0f)));
  const V amplitude = envelope.value.of(d, t, weight);
  V cosine, sine;
  CosineSine(d, hn::MulAdd(offset, wave, phase), cosine, sine);

  AxisFactor<V> factor{{hn::Mul(amplitude, cosine), hn::Mul(amplitude, sine)}, {hn::Zero(d), hn::Zero(d)}};
  if constexpr (kDerivatives == Derivatives::gradient) {
    // d amplitude / d scaled = -2 scaled (3 t^2 P + t^3 P'); d wave / d scaled = i 2 pi wave / scale.
    const V amplitude_slope = hn::Mul(hn::Mul(hn::Set(d, -2.0f), scaled), envelope.slope.of(d, t, weight));
    const V turning = hn::Mul(hn::Mul(amplitude, wave), hn::Set(d, 2.0f * std::numbers::pi_v<float> / scale));
    factor.derivative = {hn::NegMulAdd(turning, sine, hn::Mul(amplitude_slope, cosine)),
                         hn::MulAdd(turning, cosine, hn::Mul(amplitude_slope, sine))};
  }
  return factor;
}

}  // namespace HWY_NAMESPACE
}  // namespace solidnoise
HWY_AFTER_NAMESPACE();

#endif  // SOLIDNOISE_ORIENTED_FACTOR_INL

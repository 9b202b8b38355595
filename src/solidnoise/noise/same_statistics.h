#pragma once

#include <memory>
#include <utility>

#include "solidnoise/noise/noise.h"

namespace solidnoise {

// A noise that is another one, elsewhere or evaluated in another way: it has its statistics.
template <int Dim>
class SameStatistics : public Noise<Dim> {
 public:
  explicit SameStatistics(std::shared_ptr<const Noise<Dim>> noise) : noise_(std::move(noise)) {}

  using Noise<Dim>::evaluate;
  double variance() const final { return noise_->variance(); }
  Vec<Dim> gradient_variance() const final { return noise_->gradient_variance(); }
  double power_spectrum(const Vec<Dim>& frequency) const final { return noise_->power_spectrum(frequency); }
  double excess_kurtosis() const final { return noise_->excess_kurtosis(); }
  typename Noise<Dim>::Band band() const final { return noise_->band(); }
  WaveMixture<Dim> waves() const final { return noise_->waves(); }
  double covariance(const Vec<Dim>& displacement) const final { return noise_->covariance(displacement); }

 protected:
  const Noise<Dim>& noise() const { return *noise_; }

 private:
  std::shared_ptr<const Noise<Dim>> noise_;
};

}  // namespace solidnoise

#include "reference/gabor_reference.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "solidnoise/noise/kernel/isotropic_gabor_kernel.h"

namespace solidnoise::gabor_reference_test {
namespace {

constexpr double kFrequency = 1.0;
constexpr double kA = 0.7;
constexpr double kImpulses = 32.0;

// Mean of n(x) n(x + lag) over points so far apart that no kernel reaches two of them.
template <int Dim, typename Procedure>
double measure_covariance(const Procedure& noise, double lag, double radius, int count) {
  double sum = 0.0;
  for (int i = 0; i < count; ++i) {
    reference::Position<Dim> point{};
    for (double& coordinate : point) coordinate = -0.37;
    point[0] += (2.0 * radius + 1.0 / kFrequency) * i;
    reference::Position<Dim> other = point;
    other[Dim - 1] += lag;
    sum += noise(point) * noise(other);
  }
  return sum / count;
}

// `correlation` and `excess_kurtosis` are those of the procedure's noise in closed form.
template <int Dim, template <int, typename> class Kernel, typename Correlation>
void expect_covariance(const Correlation& correlation, double radius, double excess_kurtosis) {
  const reference::GaborProcedure<Dim, Kernel> noise({kFrequency, kA}, radius, kImpulses, 11u);
  constexpr int kCount = 8000;
  // The product's variance is at most the fourth moment, 3 + excess kurtosis. 4 sigma; and the kernel is cut
  // where it has lost 0.002 of its norm, which changes a covariance by at most twice that.
  const double tolerance = 4.0 * std::sqrt((3.0 + excess_kurtosis) / kCount) + 2.0 * 0.002;
  for (const double lag : {0.0, 0.25, 0.5, 0.8}) {
    EXPECT_NEAR(measure_covariance<Dim>(noise, lag / kFrequency, radius, kCount),
                correlation(lag / kFrequency), tolerance)
        << Dim << "D, lag " << lag;
  }
}

template <int Dim>
void expect_isotropic_covariance() {
  const auto kernel = IsotropicGaborKernel<Dim>::with_unit_peak(kFrequency, kA);
  const double radius = kernel.radius_for_error(0.002);
  const double density = kImpulses / (reference::kBall<Dim> * std::pow(radius, Dim));
  // Weights uniform on [-1, 1]: E[W^4] / E[W^2]^2 = 9 / 5.
  const double kurtosis = 1.8 * kernel.fourth_moment() / (density * kernel.energy() * kernel.energy());
  expect_covariance<Dim, reference::IsotropicKernel>(
      [&](double lag) { return kernel.autocorrelation(lag) / kernel.energy(); }, radius, kurtosis);
}

template <int Dim>
void expect_oriented_covariance() {
  const double radius = 2.0 / kA;  // exp(-2 pi (a r)^2) is below 1e-10 there
  // Campbell: (3/2) a^n / density, for the kernel's fourth and second moments.
  const double kurtosis = 1.5 * reference::kBall<Dim> * std::pow(kA * radius, Dim) / kImpulses;
  expect_covariance<Dim, reference::OrientedKernel>(
      [](double lag) {
        return std::exp(-std::numbers::pi * kA * kA * lag * lag / 2.0) *
               reference::mean_cosine<Dim, double>(2.0 * std::numbers::pi * kFrequency * lag);
      },
      radius, kurtosis);
}

TEST(GaborReference, IsotropicProcedureHasTheCovarianceOfTheClosedForm) {
  expect_isotropic_covariance<1>();
  expect_isotropic_covariance<2>();
  expect_isotropic_covariance<3>();
  expect_isotropic_covariance<4>();
}

TEST(GaborReference, OrientedProcedureHasTheCovarianceOfTheClosedForm) {
  expect_oriented_covariance<1>();
  expect_oriented_covariance<2>();
  expect_oriented_covariance<3>();
  expect_oriented_covariance<4>();
}

TEST(GaborReference, SumsGivenImpulses) {
  using Impulse = reference::Impulse<2>;
  const std::array<Impulse, 2> impulses{Impulse{{0.0, 1.0}, 2.0}, Impulse{{3.0, 0.0}, -1.0}};
  const auto distance = [](const reference::Position<2>& offset, const Impulse& impulse) {
    return impulse.weight * std::hypot(offset[0], offset[1]);
  };
  // 2 * |(0, -1)| - |(-3, 0)|, exact in floating point.
  EXPECT_EQ(reference::sum_impulses<2>(impulses, {0.0, 0.0}, distance), -1.0);
}

}  // namespace
}  // namespace solidnoise::gabor_reference_test

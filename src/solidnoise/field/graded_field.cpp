#include "solidnoise/field/graded_field.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <numbers>
#include <span>
#include <utility>
#include <vector>

#include "solidnoise/field/pointwise_field.h"

namespace solidnoise {
namespace {

// Points by their numbers among others, with all that these know of them.
class SomePoints {
 public:
  void add(const Points<3>& points, std::size_t i) {
    numbers_.push_back(i);
    positions_.push_back(points.positions[i]);
    if (!points.normals.empty()) normals_.push_back(points.normals[i]);
    if (!points.vertices.empty()) vertices_.push_back(points.vertices[i]);
  }

  std::span<const std::size_t> numbers() const { return numbers_; }
  Points<3> points() const { return {positions_, normals_, vertices_}; }

 private:
  std::vector<std::size_t> numbers_;
  std::vector<Vec<3>> positions_;
  std::vector<Vec<3>> normals_;
  std::vector<std::uint32_t> vertices_;
};

class GradedField final : public PointwiseField {
 public:
  GradedField(VaryingParameter frequency, double unit, const GradedNoise& noise)
      : frequency_(std::move(frequency)), unit_(unit) {
    lowest_ = static_cast<int>(std::floor(grade_of(frequency_.least)));
    const int highest = static_cast<int>(std::floor(grade_of(frequency_.greatest))) + 1;
    for (int grade = lowest_; grade <= highest; ++grade) {
      grades_.push_back(noise(std::exp2(static_cast<double>(grade) / kGradesPerOctave) / unit, grade));
    }
  }

  bool has_gradient() const override {
    return std::ranges::all_of(grades_, [](const FieldPtr& noise) { return noise->has_gradient(); });
  }

  void evaluate(const Points<3>& points, const Samples<3>& samples) const override {
    require_room(samples, points.size());
    std::vector<float> frequencies(points.size());
    frequency_.field->evaluate(points, {frequencies, {}});
    std::vector<SomePoints> of_grade(grades_.size());
    std::vector<std::vector<float>> weights(grades_.size());
    const auto add = [&](std::size_t grade, std::size_t point, double weight) {
      if (weight == 0.0) return;
      of_grade[grade].add(points, point);
      weights[grade].push_back(static_cast<float>(weight));
    };
    for (std::size_t i = 0; i < points.size(); ++i) {
      const double place =
          grade_of(std::clamp<double>(frequencies[i], frequency_.least, frequency_.greatest));
      const double below = std::floor(place);
      const auto grade = static_cast<std::size_t>(static_cast<int>(below) - lowest_);
      const double t = place - below;
      // Smooth at its ends, so that no grade's begins with a crease.
      const double angle = 0.5 * std::numbers::pi * t * t * (3.0 - 2.0 * t);
      add(grade, i, std::cos(angle));
      add(grade + 1, i, std::sin(angle));
    }
    fill_with_zero(samples);
    for (std::size_t grade = 0; grade < grades_.size(); ++grade) {
      if (weights[grade].empty()) continue;
      add_grade(*grades_[grade], of_grade[grade], weights[grade], samples);
    }
  }

  std::optional<Statistics> statistics() const override {
    const auto low = grades_.front()->statistics();
    const auto high = grades_.back()->statistics();
    if (!low || !high) return std::nullopt;
    return Statistics{0.0, low->variance, low->excess_kurtosis, {low->band.lower, high->band.upper}};
  }

 private:
  // Where a frequency is among the grades: log2(f / 1 cycle per unit) in grades.
  double grade_of(double frequency) const { return kGradesPerOctave * std::log2(frequency * unit_); }

  static void add_grade(const Field<3>& noise, const SomePoints& some, std::span<const float> weights,
                        const Samples<3>& samples) {
    const SampleBuffer<3> buffer(samples.subspan(0, weights.size()));
    const Samples<3>& of_grade = buffer.samples();
    noise.evaluate(some.points(), of_grade);
    for (std::size_t k = 0; k < weights.size(); ++k) {
      const std::size_t i = some.numbers()[k];
      samples.values[i] += weights[k] * of_grade.values[k];
      for (std::size_t axis = 0; samples.wants_gradient() && axis < 3; ++axis) {
        samples.gradient[axis][i] += weights[k] * of_grade.gradient[axis][k];
      }
    }
  }

  VaryingParameter frequency_;
  double unit_;  // world units
  int lowest_ = 0;
  std::vector<FieldPtr> grades_;  // from the lowest on, one more than the highest
};

}  // namespace

FieldPtr make_graded_field(const VaryingParameter& frequency, double unit, const GradedNoise& noise) {
  return std::make_shared<GradedField>(frequency, unit, noise);
}

}  // namespace solidnoise

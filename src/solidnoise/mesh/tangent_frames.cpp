#include "solidnoise/mesh/tangent_frames.h"

#include <cmath>

#include <glm/geometric.hpp>

namespace solidnoise {

std::complex<double> TangentFrame::in_frame(const Vec<3>& tangent) const {
  return {glm::dot(tangent, first), glm::dot(tangent, second)};
}

std::complex<double> transport(const TangentFrame& from, const TangentFrame& to) {
  // The rotation takes u, perpendicular to m, to u - (u.n) (m + n) / (1 + m.n). For opposite normals there is
  // no smallest one, and no frame is better than another.
  constexpr double kOpposite = 1e-9;
  const double cosine = 1.0 + glm::dot(from.normal, to.normal);
  if (cosine < kOpposite) return 1.0;
  const Vec<3> rotated = from.first - glm::dot(from.first, to.normal) / cosine * (from.normal + to.normal);
  const std::complex<double> result = to.in_frame(rotated);
  return result / std::abs(result);
}

std::complex<double> direction_of_line(std::complex<double> line) {
  return std::polar(1.0, 0.5 * std::arg(line));
}

void LineMean::add(const Vec<3>& line, double weight) {
  sum_ += (glm::dot(sum_, line) < 0.0 ? -weight : weight) * line;
  length_ += weight * glm::length(line);
  weight_ += weight;
}

Vec<3> LineMean::line() const {
  const double length = glm::length(sum_);
  return length > 0.0 ? length_ / (weight_ * length) * sum_ : sum_;
}

}  // namespace solidnoise

#include "solidnoise/volume/slice/slice_view.h"

#include <algorithm>
#include <cmath>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "solidnoise/volume/slice/noise_slice.h"

namespace solidnoise {
namespace {

// The normal and what is up say one thing together.
void turn_plane(const SliceView& view, SlicePlane& plane) {
  if (!view.normal && !view.up) return;
  const Vec<3> normal = view.normal.value_or(Vec<3>(0.0, 0.0, 1.0));
  const bool from_above = std::hypot(normal.x, normal.z) < 1e-3 * std::abs(normal.y);
  plane.face(normal, view.up.value_or(from_above ? Vec<3>(0.0, 0.0, -1.0) : Vec<3>(0.0, 1.0, 0.0)));
}

}  // namespace

void place_plane(const SliceView& view, SliceRecipe& recipe) {
  constexpr double kWidth = 2.0;  // world units
  SlicePlane& plane = recipe.plane;
  turn_plane(view, plane);
  if (view.origin) plane.origin = *view.origin;
  if (recipe.file.empty() && is_bounded(recipe)) return fit_plane(view, recipe.recipe.box, plane);
  const double period = recipe.file.empty() ? period_along(plane.right, recipe.recipe.noise) : 0.0;
  const double width = view.width.value_or(period > 0.0 ? period : kWidth);
  plane.pixel = width / plane.columns;
  const double height = plane.pixel * plane.rows;
  recipe.wraps = period > 0.0 && width == period && height == period_along(plane.up, recipe.recipe.noise);
}

void fit_plane(const SliceView& view, const Box<3>& bounds, SlicePlane& plane) {
  if (!view.origin) plane.origin = 0.5 * (bounds.lower + bounds.upper);
  if (view.width) {
    plane.pixel = *view.width / plane.columns;
    return;
  }
  const Vec<3> size = bounds.upper - bounds.lower;
  plane.pixel = glm::dot(size, glm::abs(plane.right)) / plane.columns;
  if (plane.rows > 1) plane.pixel = std::max(plane.pixel, glm::dot(size, glm::abs(plane.up)) / plane.rows);
}

}  // namespace solidnoise

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <memory>
#include <utility>

#include <glm/geometric.hpp>
#include <nlohmann/json.hpp>

#include "pictures.h"
#include "solidnoise/field/combined_field.h"
#include "solidnoise/field/pointwise_field.h"
#include "solidnoise/field/shaping.h"
#include "solidnoise/field/value_maps.h"
#include "solidnoise/noise/error_budget.h"
#include "solidnoise/noise/interpolation/interpolated_noise.h"
#include "solidnoise/noise/noise_views.h"
#include "solidnoise/volume/volume_field.h"

namespace solidnoise::studio {
namespace {

Vec<3> vector_of(const Json& numbers) {
  return {numbers[0].get<double>(), numbers[1].get<double>(), numbers[2].get<double>()};
}

class EllipsoidMask final : public PointwiseField {
 public:
  EllipsoidMask(const Vec<3>& centre, const Vec<3>& radii) : centre_(centre), radii_(radii) {}

  void evaluate(const Points<3>& points, const Samples<3>& samples) const override {
    for (std::size_t i = 0; i < points.size(); ++i) {
      samples.values[i] = glm::length((points.positions[i] - centre_) / radii_) <= 1.0 ? 1.0f : 0.0f;
    }
  }

 private:
  Vec<3> centre_;
  Vec<3> radii_;
};

// Whether the grid is a noise, or three for its colours, that `vdbnoise slice` takes as it is.
bool is_plain(const VolumeRecipe& grid) {
  const bool colors = grid.output == std::vector{Output::color};
  const bool raw = std::holds_alternative<RawShaping>(grid.shaping);
  return raw && !grid.within && grid.layers.empty() && std::holds_alternative<BoxShape>(grid.shape) &&
         (is_scalar(grid) || colors);
}

// A noise in the place of the recipe's on the pixels of a plane, as make_slice_fields() has it: interpolated
// where that is quicker. That would bring noises of fewer dimensions along, and the band of frequencies,
// which takes longer to find than a slider may wait.
SliceField plain_field(VolumeRecipe recipe, const NoiseRecipe& noise, const SlicePlane& plane) {
  recipe.noise = noise;
  recipe.output = {Output::value};
  const auto solid = make_volume_noise(recipe);
  const RawShaping& raw = std::get<RawShaping>(recipe.shaping);
  SliceField field;
  field.sigma = std::sqrt(solid->variance());
  const Normalization normalization = normalization_of(recipe, recipe.box);
  if (!recipe.exact) {
    LatticeFrame<2> frame{Vec<2>(0.0), Vec<2>(plane.pixel)};
    for (const auto& [axis, direction] : {std::pair(0, plane.right), std::pair(1, plane.up)}) {
      frame.period[axis] = whole_period(period_along(direction, noise), frame.step[axis]);
    }
    const std::shared_ptr<const Noise<2>> flat =
        on_plane(solid, {plane.position(0, 0), plane.right, plane.up});
    const auto interpolated = interpolate<2>(flat, frame, ErrorBudget(error_of(noise)).interpolation);
    if (interpolated != flat) field.source = make_slice_source(interpolated, frame, normalization, raw.range);
  }
  if (!field.source) field.source = make_slice_source(shape(map_field(solid, normalization), raw));
  return field;
}

// How a picture shows the values: "low" and "high" are black and white, "colors" are in linear light or
// "encoded", "vector" is one whose length counts. Without "low" it is the least and the greatest of the
// picture.
Json shown_of(const VolumeRecipe& grid, const SliceSubject& subject) {
  const auto* const raw = std::get_if<RawShaping>(&grid.shaping);
  if (!raw) return {{"low", 0.0}, {"high", 1.0}};
  if (const ExemplarModel* const exemplar = exemplar_of_colors(grid); exemplar && !is_scalar(grid)) {
    return {{"colors", true}, {"encoded", exemplar->raw_values}, {"low", 0.0}, {"high", 1.0}};
  }
  const Output output = grid.output.front();
  if (output == Output::curl || output == Output::gradient) return {{"vector", true}};
  const double sigma = subject.plain.empty() ? 0.0 : subject.plain.front().sigma;
  Json shown{{"sigma", sigma}};
  if (sigma == 0.0) return shown;
  if (raw->range == RawShaping::Range::unit) return {{"low", 0.0}, {"high", 1.0}};
  if (raw->range == RawShaping::Range::signed_values) return {{"low", -1.0}, {"high", 1.0}};
  shown["low"] = -3.0 * sigma;
  shown["high"] = 3.0 * sigma;
  return shown;
}

SliceSubject make_subject(const Json& question) {
  SliceSubject subject;
  subject.plane = plane_of(question.at("plane"));
  VolumeRecipe grid = timed_grid(question);
  if (is_plain(grid)) {
    grid.exact = grid.exact || question.value("draft", false);
    const VolumeRecipe sharp = at_resolution(grid, Vec<3>(subject.plane.pixel));
    const bool color = grid.output == std::vector{Output::color};
    for (int channel = 0; channel < (color ? 3 : 1); ++channel) {
      subject.plain.push_back(
          plain_field(sharp, color ? channel_of(sharp.noise, channel) : sharp.noise, subject.plane));
    }
    if (const ExemplarModel* const exemplar = exemplar_of_colors(grid); exemplar && color)
      subject.exemplar = *exemplar;
  }
  if (subject.plain.empty()) {
    grid.exact = true;  // at points there is nothing to interpolate, and to plan
    const VolumePlan plan = plan_in_box(grid, subject.plane.pixel);
    subject.field = within_shape(make_volume_field(grid, plan).field, grid);
  }
  subject.shown = shown_of(grid, subject);
  return subject;
}

}  // namespace

VolumePlan plan_in_box(const VolumeRecipe& grid, double voxel) {
  VolumePlan plan;
  plan.box = grid.box;
  plan.shape = grid.shape;
  plan.frame = GridFrame(voxel);
  plan.voxels = plan.frame.voxels_in(plan.box);
  return plan;
}

FieldPtr within_shape(FieldPtr field, const VolumeRecipe& grid) {
  if (std::holds_alternative<BoxShape>(grid.shape)) return field;
  Vec<3> radii = 0.5 * (grid.box.upper - grid.box.lower);
  if (std::holds_alternative<SphereShape>(grid.shape)) radii = Vec<3>(std::min({radii.x, radii.y, radii.z}));
  return masked(std::move(field),
                std::make_shared<EllipsoidMask>(0.5 * (grid.box.lower + grid.box.upper), radii));
}

VolumeRecipe timed_grid(const Json& question) {
  VolumeRecipe grid = grid_of_question(question);
  if (question.contains("time")) {
    grid.time = question.at("time");
    grid.validate();
  }
  return grid;
}

SlicePlane plane_of(const Json& json) {
  SlicePlane plane;
  plane.origin = vector_of(json.at("origin"));
  plane.face(vector_of(json.at("normal")), vector_of(json.at("up")));
  plane.columns = json.at("columns");
  plane.rows = json.at("rows");
  plane.pixel = json.at("width").get<double>() / plane.columns;
  return plane;
}

const SliceSubject& subject_of(const Json& question) {
  static std::string known;
  static SliceSubject subject;
  const std::string key =
      Json{question.at("recipe"), question.value("grid", ""), question.value("time", Json()),
           question.at("plane"), question.value("draft", false)}
          .dump();
  if (key != known) {
    known.clear();
    subject = make_subject(question);
    known = key;
  }
  return subject;
}

// A tile of pixels, "first" to "count" in columns and rows from the bottom; column by column, as vdbnoise has
// them. With "draft" without plans for many pixels, which take longer than a few of them. "ready" is after
// how many milliseconds the first pixel was begun.
Answer make_slice(const Json& question, std::span<const unsigned char>) {
  const auto begin = std::chrono::steady_clock::now();
  const SliceSubject& subject = subject_of(question);
  const std::chrono::duration<double, std::milli> ready = std::chrono::steady_clock::now() - begin;
  const Json& first = question.at("first");
  const Json& count = question.at("count");
  const glm::ivec2 from(first[0].get<int>(), first[1].get<int>());
  const glm::ivec2 size(count[0].get<int>(), count[1].get<int>());
  const std::size_t pixels = static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y);
  Answer answer{subject.shown};
  answer.json["ready"] = ready.count();
  if (subject.field) {
    std::vector<Vec<3>> positions;
    positions.reserve(pixels);
    for (int column = from.x; column < from.x + size.x; ++column) {
      for (int row = from.y; row < from.y + size.y; ++row) {
        positions.push_back(subject.plane.position(column, row));
      }
    }
    const auto channels = static_cast<std::size_t>(subject.field->channels());
    std::vector<float> values(channels * pixels);
    subject.field->evaluate(Points<3>{positions}, Samples<3>{values, {}});
    for (std::size_t c = 0; c < channels; ++c) {
      const auto begin = values.begin() + static_cast<std::ptrdiff_t>(c * pixels);
      answer.floats.emplace_back(begin, begin + static_cast<std::ptrdiff_t>(pixels));
    }
    return answer;
  }
  for (const SliceField& channel : subject.plain) {
    channel.source->evaluate(subject.plane, from, size, answer.floats.emplace_back(pixels));
  }
  if (subject.exemplar) {  // whose colours are a mixture of the channels
    for (std::size_t i = 0; i < pixels; ++i) {
      const std::array<double, 3> values{answer.floats[0][i], answer.floats[1][i], answer.floats[2][i]};
      const Vec<3> color = subject.exemplar->color(values);
      for (std::size_t c = 0; c < 3; ++c)
        answer.floats[c][i] = static_cast<float>(color[static_cast<int>(c)]);
    }
  }
  return answer;
}

}  // namespace solidnoise::studio

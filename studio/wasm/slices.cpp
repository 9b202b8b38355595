#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <utility>

#include <glm/geometric.hpp>
#include <nlohmann/json.hpp>

#include "pictures.h"
#include "solidnoise/field/combined_field.h"
#include "solidnoise/field/pointwise_field.h"
#include "solidnoise/field/value_maps.h"
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

// Whether `vdbnoise slice` takes the grid as it is.
bool is_plain(const VolumeRecipe& grid) {
  const bool colors = grid.output == std::vector{Output::color};
  const bool raw = std::holds_alternative<RawShaping>(grid.shaping);
  return raw && !grid.within && grid.fields.empty() && std::holds_alternative<BoxShape>(grid.shape) &&
         (is_scalar(grid) || (colors && grid.layers.empty()));
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
  if (raw->range == RawShaping::Range::unit) return {{"low", 0.0}, {"high", 1.0}};
  if (raw->range == RawShaping::Range::signed_values) return {{"low", -1.0}, {"high", 1.0}};
  if (sigma > 0.0) {
    shown["low"] = -3.0 * sigma;
    shown["high"] = 3.0 * sigma;
  }
  return shown;
}

SliceSubject make_subject(const Json& question) {
  SliceSubject subject;
  subject.plane = plane_of(question.at("plane"));
  VolumeRecipe grid = timed_grid(question);
  if (is_plain(grid)) {
    SliceRecipe slice;
    slice.recipe = grid;
    slice.plane = subject.plane;
    slice.color = grid.output == std::vector{Output::color};
    if (slice.color) slice.recipe.output = {Output::value};
    subject.plain = make_slice_fields(slice);
    if (const ExemplarModel* const exemplar = exemplar_of_colors(grid); exemplar && slice.color)
      subject.exemplar = *exemplar;
  }
  if (subject.plain.empty()) {
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
  const std::string key = Json{question.at("recipe"), question.value("grid", ""),
                               question.value("time", Json()), question.at("plane")}
                              .dump();
  if (key != known) {
    known.clear();
    subject = make_subject(question);
    known = key;
  }
  return subject;
}

// A tile of pixels, "first" to "count" in columns and rows from the bottom; column by column, as vdbnoise has
// them.
Answer make_slice(const Json& question, std::span<const unsigned char>) {
  const SliceSubject& subject = subject_of(question);
  const Json& first = question.at("first");
  const Json& count = question.at("count");
  const glm::ivec2 from(first[0].get<int>(), first[1].get<int>());
  const glm::ivec2 size(count[0].get<int>(), count[1].get<int>());
  const std::size_t pixels = static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y);
  Answer answer{subject.shown};
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

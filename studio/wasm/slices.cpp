#include <array>
#include <chrono>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "pictures.h"
#include "solidnoise/field/combined_field.h"
#include "solidnoise/volume/shape_field.h"
#include "solidnoise/volume/volume_field.h"

namespace solidnoise::studio {
namespace {

Vec<3> vector_of(const Json& numbers) {
  return {numbers[0].get<double>(), numbers[1].get<double>(), numbers[2].get<double>()};
}

// How a picture shows the values: "low" and "high" are black and white, "colors" are in linear light or
// "encoded", "vector" is one whose length counts. Without "low" it is the least and the greatest of the
// picture.
Json shown_of(const VolumeRecipe& grid) {
  if (!std::holds_alternative<RawShaping>(grid.shaping)) return {{"low", 0.0}, {"high", 1.0}};
  const ExemplarModel* const exemplar = exemplar_of_colors(grid);
  if (exemplar && !is_scalar(grid)) {
    return {{"colors", true}, {"encoded", exemplar->raw_values}, {"low", 0.0}, {"high", 1.0}};
  }
  const Output output = grid.output.front();
  if (output == Output::curl || output == Output::gradient) return {{"vector", true}};
  return Json::object();
}

// That would bring files along, noises of fewer dimensions, and the band of frequencies, which takes longer
// to find than a slider may wait: not by make_slice_field().
void add_noise(const VolumeRecipe& grid, SliceSubject& subject) {
  VolumeRecipe single = at_resolution(grid, Vec<3>(subject.plane.pixel));
  single.output = {Output::value};
  const bool color = !is_scalar(grid);
  const NoiseRecipe noise_of_all = single.noise;
  std::vector<SliceSourcePtr> channels;
  std::vector<double> variances;
  for (int channel = 0; channel < (color ? 3 : 1); ++channel) {
    if (color) single.noise = channel_of(noise_of_all, channel);
    const NoiseSlice noise = make_noise_slice(single, subject.plane);
    channels.push_back(noise.source);
    subject.sigma = noise.sigma;
    variances.push_back(variance_of(single, noise));
    if (subject.shown.empty() && noise.sigma > 0.0) {
      subject.shown = {{"low", noise.shown.first}, {"high", noise.shown.second}};
    }
  }
  subject.source = side_by_side(std::move(channels));
  if (const ExemplarModel* const exemplar = exemplar_of_colors(grid); exemplar && color)
    subject.color_of.emplace(*exemplar, variances);
}

SliceSubject make_subject(const Json& question) {
  SliceSubject subject;
  subject.plane = plane_of(question.at("plane"));
  VolumeRecipe grid = timed_grid(question);
  subject.shown = shown_of(grid);
  if (is_noise_alone(grid)) {
    grid.exact = grid.exact || question.value("draft", false);
    add_noise(grid, subject);
  } else {
    grid.exact = true;  // at points there is nothing to interpolate, and to plan
    subject.source = make_slice_source(field_in_shape(grid, plan_in_box(grid, subject.plane.pixel)));
  }
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

FieldPtr field_in_shape(const VolumeRecipe& grid, const VolumePlan& plan) {
  FieldPtr field = make_volume_field(grid, plan).field;
  if (std::holds_alternative<BoxShape>(grid.shape)) return field;
  return masked(std::move(field), shape_at_points(grid, plan.frame.voxel_size().x));
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
  const auto channels = static_cast<std::size_t>(subject.source->channels());
  std::vector<float> values(channels * pixels);
  subject.source->evaluate(subject.plane, from, size, values);
  for (std::size_t c = 0; c < channels; ++c) {
    const auto begin_of_channel = values.begin() + static_cast<std::ptrdiff_t>(c * pixels);
    answer.floats.emplace_back(begin_of_channel, begin_of_channel + static_cast<std::ptrdiff_t>(pixels));
  }
  if (subject.color_of) {
    for (std::size_t i = 0; i < pixels; ++i) {
      const std::array<double, 3> values{answer.floats[0][i], answer.floats[1][i], answer.floats[2][i]};
      const Vec<3> color = (*subject.color_of)(values);
      for (std::size_t c = 0; c < 3; ++c)
        answer.floats[c][i] = static_cast<float>(color[static_cast<int>(c)]);
    }
  }
  return answer;
}

}  // namespace solidnoise::studio

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <stdexcept>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "commands.h"
#include "solidnoise/analysis/exemplar/describe_fit.h"
#include "solidnoise/analysis/exemplar/edit_model.h"
#include "solidnoise/analysis/exemplar/edit_spectrum.h"
#include "solidnoise/analysis/exemplar/exemplar.h"
#include "solidnoise/analysis/exemplar/exemplar_sheet.h"
#include "solidnoise/analysis/exemplar/fit_exemplar.h"
#include "solidnoise/analysis/exemplar/gaussian_field.h"
#include "solidnoise/analysis/exemplar/prepare_exemplars.h"
#include "solidnoise/analysis/exemplar/square_colors.h"
#include "solidnoise/image/color.h"
#include "solidnoise/recipe/exemplar_model_json.h"

// Told while a fit goes on, 0 to 1.
extern "C" __attribute__((import_module("env"), import_name("progress"))) void tell_progress(double done);

namespace solidnoise::studio {
namespace {

class PageProgress final : public Progress {
 public:
  void advance(std::uint64_t done, std::uint64_t total) override {
    const double now = static_cast<double>(done) / static_cast<double>(std::max<std::uint64_t>(total, 1));
    if (now < told_ + 0.01) return;
    told_ = now;
    tell_progress(now);
  }
  bool cancelled() override { return false; }

 private:
  double told_ = 0.0;
};

// A photograph's pixels, red, green, blue and alpha in bytes, and as what of them a noise is learnt.
struct Photograph {
  Exemplar<2> exemplar;
  ValueChoice values;
};
Photograph photograph_of(const Json& question, std::span<const unsigned char> bytes) {
  Image image(question.at("width"), question.at("height"), 3);
  for (std::size_t i = 0; i < image.pixels.size(); ++i) {
    image.pixels[i] = static_cast<float>(bytes[i / 3 * 4 + i % 3]) / 255.0f;
  }
  std::vector<Exemplar<2>> exemplars{
      exemplar_of_image(image, {.pixel_size = question.at("pixel"), .raw_values = true}, "the photograph")};
  const ValueChoice values = choose_values(exemplars, {false});
  return {std::move(exemplars.front()), values};
}

// Rows from the top, three numbers a pixel for the screen.
Answer picture_of(const Exemplar<2>& texture, bool raw) {
  const Image image = image_of_exemplar(texture);
  std::vector<float> pixels = image.pixels;
  if (!raw) {
    for (float& pixel : pixels) pixel = srgb_from_linear(pixel);
  }
  return {Json{{"width", image.width}, {"height", image.height}}, {std::move(pixels)}};
}

std::string text_of(const ExemplarModel& model) {
  return to_json(model).dump();
}

SpectrumComponent& component_at(GaborSpectrum& spectrum, const Json& edit) {
  return spectrum.bands.at(edit.at("band")).components.at(edit.at("component"));
}

void drop(GaborSpectrum& spectrum, const Json& edit) {
  const std::size_t band = edit.at("band");
  auto& components = spectrum.bands.at(band).components;
  components.erase(components.begin() + edit.at("component").get<std::ptrdiff_t>());
  if (components.empty()) spectrum.bands.erase(spectrum.bands.begin() + static_cast<std::ptrdiff_t>(band));
}

// Another width of its Gaussian: it goes to another band.
void widen(GaborSpectrum& spectrum, const Json& edit) {
  const SpectrumComponent component = component_at(spectrum, edit);
  const double a = spectrum.bands[edit.at("band")].a * edit.at("by").get<double>();
  drop(spectrum, edit);
  add_component(spectrum, a, component, spectrum.groups[static_cast<std::size_t>(component.group)]);
}

using Edit = std::function<void(GaborSpectrum&, const Json&)>;
GroupChoice group_of(const Json& edit) {
  return edit.contains("group") ? GroupChoice(edit.at("group").get<std::string>()) : std::nullopt;
}

const std::map<std::string, Edit>& edits() {
  static const std::map<std::string, Edit> known{
      {"rotate", [](auto& s, const Json& e) { rotate_group(s, group_of(e), e.at("by")); }},
      {"scale", [](auto& s, const Json& e) { scale_group(s, group_of(e), e.at("by")); }},
      {"magnitude", [](auto& s, const Json& e) { scale_magnitude(s, group_of(e), e.at("by")); }},
      {"bandwidth", [](auto& s, const Json& e) { scale_bandwidth(s, group_of(e), e.at("by")); }},
      {"remove", [](auto& s, const Json& e) { remove_group(s, e.at("group")); }},
      {"move",
       [](auto& s, const Json& e) {
         component_at(s, e).frequency = {e.at("to")[0].get<double>(), e.at("to")[1].get<double>(), 0.0};
       }},
      {"variance", [](auto& s, const Json& e) { component_at(s, e).variance *= e.at("by").get<double>(); }},
      {"width", widen},
      {"drop", drop},
      {"add", [](auto& s, const Json& e) {
         SpectrumComponent component;
         component.frequency = {e.at("to")[0].get<double>(), e.at("to")[1].get<double>(), 0.0};
         component.variance = e.at("variance");
         add_component(s, e.at("a"), component, "added");
       }}};
  return known;
}

// As text, which goes between page and workers quicker than an object of a thousand numbers; read once, as
// long as only what is done to it changes. "edits" are of the components or groups of all channels, or of
// one.
ExemplarModel model_of(const Json& question) {
  static std::string known;
  static ExemplarModel known_model;
  const std::string text = question.at("exemplar");
  if (text != known) {
    known.clear();
    known_model =
        exemplar_file_from_json(Json{{"solidnoise", kRecipeVersion}, {"exemplar", parse_json(text)}});
    known = text;
  }
  ExemplarModel model = known_model;
  if (!question.contains("edits")) return model;
  for (const Json& edit : question.at("edits")) {
    EditTarget target{.group = group_of(edit)};
    if (edit.contains("channel")) target.channel = edit.at("channel").get<int>();
    edit_model(model, target,
               [&](GaborSpectrum& spectrum, std::size_t) { edits().at(edit.at("edit"))(spectrum, edit); });
  }
  model.validate();
  return model;
}

}  // namespace

// A model of the photograph in `bytes`.
Answer fit_example(const Json& question, std::span<const unsigned char> bytes) {
  const auto [exemplar, values] = photograph_of(question, bytes);
  exemplar.validate("the photograph");
  ExemplarFitOptions options;
  options.spectrum.kappa = question.value("kappa", options.spectrum.kappa);
  const std::string axes = question.value("axes", "independent");
  options.axes = axes == "rgb" ? ColorAxes::rgb : axes == "pca" ? ColorAxes::pca : ColorAxes::independent;
  options.raw_values = values.raw_values;
  options.squares = values.squares;
  PageProgress progress;
  const ExemplarFit<2> fit = fit_exemplar<2>(std::span(&exemplar, 1), options, &progress);
  Json json{
      {"exemplar", text_of(fit.model)}, {"report", describe_shortly(fit, 0.0)}, {"warnings", Json::array()}};
  for (const std::string& warning : test_gaussianity(exemplar.channels.front()).warnings)
    json["warnings"].push_back(warning);
  return {json};
}

// The best that noise can do of the photograph in `bytes`.
Answer draw_version(const Json& question, std::span<const unsigned char> bytes) {
  const auto [exemplar, values] = photograph_of(question, bytes);
  const std::uint64_t seed = question.value("seed", std::uint64_t{1});
  return picture_of(values.squares ? squared_version(exemplar, seed) : gaussian_version(exemplar, seed),
                    values.raw_values);
}

// The model's "sparse" texture, or its noise, of that a tile from the "first" column on.
Answer draw_example(const Json& question, std::span<const unsigned char>) {
  const ExemplarModel model = model_of(question);
  const glm::ivec2 count(question.at("width").get<int>(), question.at("height").get<int>());
  const Vec<2> step(question.at("pixel").get<double>());
  const std::uint64_t seed = question.value("seed", std::uint64_t{1});
  const Vec<3> origin(question.value("first", 0) * step.x, 0.0, 0.0);
  return picture_of(question.value("sparse", false) ? gaussian_texture(model, count, step, seed)
                                                    : procedural_texture(model, count, step, origin, seed),
                    model.raw_values);
}

// The model with what is done to it.
Answer edit_example(const Json& question, std::span<const unsigned char>) {
  return {Json{{"exemplar", text_of(model_of(question))}}};
}

}  // namespace solidnoise::studio

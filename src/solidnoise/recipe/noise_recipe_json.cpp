#include "solidnoise/recipe/noise_recipe_json.h"

#include <array>
#include <stdexcept>
#include <utility>
#include <variant>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "solidnoise/recipe/choices.h"
#include "solidnoise/recipe/exemplar_model_json.h"
#include "solidnoise/recipe/json_reader.h"

namespace solidnoise {
namespace {

// In the order of the alternatives of NoiseRecipe::noise.
const std::vector<std::string_view> kNoiseTypes{"gabor", "gabor-oriented", "kensler", "spectrum"};

// Each list of fields is written once: `field(name, member)` and `choice(name, table, member)` read or write.
template <typename Options, typename Field>
void visit_band(Options& options, Field& field) {
  field("frequency", options.frequency);
  field("bandwidth", options.bandwidth);
  field("error", options.error);
  field("impulses", options.impulses);
  field("evolve", options.evolution.rate);
  field("loop", options.evolution.loop);
  field("filter", options.filter);
}

template <typename Field>
struct NoiseFields {
  Field& field;

  template <typename Options>
  void visit(Options& options) {
    using Plain = std::remove_const_t<Options>;
    if constexpr (std::is_same_v<Plain, GaborNoiseOptions>) {
      visit_band(options, field);
      field("weights", kImpulseWeightChoices, options.weights);
    } else if constexpr (std::is_same_v<Plain, OrientedGaborNoiseOptions>) {
      visit_band(options, field);
      field("anisotropy", options.anisotropy);
      field("direction", options.direction);
    } else if constexpr (std::is_same_v<Plain, SpectrumNoiseOptions>) {
      field("exemplar", options.model);
      field("channel", options.channel);
      field("frequency", options.frequency);
      field("error", options.error);
      field("impulses", options.impulses);
      field("evolve", options.evolution.rate);
      field("loop", options.evolution.loop);
    } else {
      static_assert(std::is_same_v<Plain, GradientNoiseOptions>);
      field("frequency", options.frequency);
      field("kernel", kGradientKernelChoices, options.kernel);
      field("support", kGradientSupportChoices, options.support);
      field("hash", kGradientHashChoices, options.hash);
    }
    field("seed", options.seed);
    field("period", options.period);
  }

  template <typename Options>
  void visit_fractal(Options& options) {
    field("octaves", options.octaves);
    field("lacunarity", options.lacunarity);
    field("gain", options.gain);
    field("renormalize", options.renormalize);
  }
};

class FieldWriter {
 public:
  explicit FieldWriter(Json& json) : json_(json) {}

  template <typename Value>
  void operator()(const char* key, const Value& value) {
    json_[key] = value;
  }
  void operator()(const char* key, const ExemplarModel& value) { json_[key] = to_json(value); }
  void operator()(const char* key, const Vec<4>& value) { json_[key] = {value.x, value.y, value.z, value.w}; }

  template <typename Enum, std::size_t Count>
  void operator()(const char* key, const Choices<Enum, Count>& choices, const Enum& value) {
    json_[key] = name_of(choices, value);
  }

 private:
  Json& json_;
};

class FieldReader {
 public:
  explicit FieldReader(JsonReader& reader) : reader_(reader) {}

  template <typename Value>
  void operator()(const char* key, Value& value) {
    reader_.read(key, value);
  }
  void operator()(const char* key, ExemplarModel& value) {
    if (auto reader = reader_.object(key)) value = exemplar_model_from_json(*reader);
  }

  template <typename Enum, std::size_t Count>
  void operator()(const char* key, const Choices<Enum, Count>& choices, Enum& value) {
    reader_.read(key, choices, value);
  }

 private:
  JsonReader& reader_;
};

using NoiseVariant = decltype(NoiseRecipe::noise);
static_assert(std::variant_size_v<NoiseVariant> == 4, "kNoiseTypes needs a name for each noise");

template <std::size_t... Is>
NoiseVariant default_alternative(std::size_t index, std::index_sequence<Is...>) {
  NoiseVariant noise;
  ((Is == index ? static_cast<void>(noise.emplace<Is>()) : void()), ...);
  return noise;
}

NoiseVariant default_alternative(std::size_t index) {
  return default_alternative(index, std::make_index_sequence<std::variant_size_v<NoiseVariant>>());
}

}  // namespace

std::string_view noise_type(const NoiseRecipe& recipe) {
  return kNoiseTypes[recipe.noise.index()];
}

NoiseRecipe default_noise(std::string_view type) {
  for (std::size_t i = 0; i < kNoiseTypes.size(); ++i) {
    if (kNoiseTypes[i] == type) return {default_alternative(i), {}};
  }
  throw std::invalid_argument(
      fmt::format("noise is {}; it must be one of {}", type, fmt::join(kNoiseTypes, ", ")));
}

Json to_json(const NoiseRecipe& recipe) {
  Json json = Json::object();
  json["type"] = noise_type(recipe);
  FieldWriter writer(json);
  NoiseFields<FieldWriter> fields{writer};
  std::visit([&](const auto& options) { fields.visit(options); }, recipe.noise);
  fields.visit_fractal(recipe.fractal);
  return json;
}

NoiseRecipe noise_recipe_from_json(JsonReader& reader) {
  NoiseRecipe recipe;
  recipe.noise = default_alternative(reader.read_choice("type", kNoiseTypes));
  FieldReader field_reader(reader);
  NoiseFields<FieldReader> fields{field_reader};
  std::visit([&](auto& options) { fields.visit(options); }, recipe.noise);
  fields.visit_fractal(recipe.fractal);
  reader.finish();
  reader.validate(recipe);
  return recipe;
}

}  // namespace solidnoise

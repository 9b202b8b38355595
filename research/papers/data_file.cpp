#include "papers/data_file.h"

#include <ostream>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "solidnoise/core/output_file.h"

namespace solidnoise::papers {
namespace {

void write_text(const std::filesystem::path& path, const std::string& text) {
  write_output(path, {.existing = Existing::replace}, [&](std::ostream& stream) { stream << text; });
}

}  // namespace

void write_table(const std::filesystem::path& path, const Table& table) {
  std::string text = fmt::format("{}\n", fmt::join(table.names, ","));
  for (const std::vector<double>& row : table.rows) text += fmt::format("{:.9g}\n", fmt::join(row, ","));
  write_text(path, text);
}

void write_json(const std::filesystem::path& path, const Json& json) {
  write_text(path, json.dump(2) + '\n');
}

void write_field(const std::filesystem::path& stem, const DenseField<2>& field) {
  const ArrayShape<2> shape{field.count};
  std::vector<float> rows;
  rows.reserve(field.values.size());
  for (int y = field.count.y - 1; y >= 0; --y) {
    for (int x = 0; x < field.count.x; ++x) rows.push_back(field.values[shape.index({x, y})]);
  }
  const std::string bytes(reinterpret_cast<const char*>(rows.data()), rows.size() * sizeof(float));
  write_text(stem.string() + ".f32", bytes);
  write_json(stem.string() + ".json", {{"columns", field.count.x}, {"rows", field.count.y}});
}

DenseField<2> centred(const PowerSpectrum<2>& spectrum) {
  DenseField<2> field(spectrum.count, Vec<2>(1.0));
  const ArrayShape<2> shape{spectrum.count};
  for (std::size_t i = 0; i < field.values.size(); ++i) {
    const glm::ivec2 at = (shape.position(i) + spectrum.count - spectrum.count / 2) % spectrum.count;
    field.values[i] = static_cast<float>(spectrum.density[shape.index(at)]);
  }
  return field;
}

}  // namespace solidnoise::papers

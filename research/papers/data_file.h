#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "solidnoise/analysis/dense_field.h"
#include "solidnoise/analysis/periodogram.h"

namespace solidnoise::papers {

using Json = nlohmann::ordered_json;

// Columns of numbers, side by side.
struct Table {
  std::vector<std::string> names;
  std::vector<std::vector<double>> rows;
};

// Files for the scripts that draw and write the pages. Each replaces what is there, and throws
// std::runtime_error that names the path. Tables are .csv with a line of names; fields NAME.f32, raw floats
// with rows from the top, and NAME.json, which says how many columns and rows there are.
void write_table(const std::filesystem::path& path, const Table& table);
void write_json(const std::filesystem::path& path, const Json& json);
void write_field(const std::filesystem::path& stem, const DenseField<2>& field);

// A spectrum as a field, frequency 0 in the middle.
DenseField<2> centred(const PowerSpectrum<2>& spectrum);

}  // namespace solidnoise::papers

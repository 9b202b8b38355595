#include "solidnoise/volume/sky/points_file.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <stdexcept>
#include <string_view>
#include <system_error>

#include <fmt/format.h>

#include "solidnoise/core/extension.h"
#include "solidnoise/core/input_file.h"
#include "solidnoise/core/printable.h"
#include "solidnoise/geometry/read_points.h"
#include "solidnoise/geometry/text_lines.h"

namespace solidnoise {
namespace {

constexpr std::uint64_t kMostBytes = 64 << 20;
constexpr std::array<std::string_view, 2> kPassedOver{"file", "scale"};

// How the numbers of one column get into points; the column's name in messages is the field's.
struct Column {
  std::string_view name;
  // Throws std::invalid_argument: field, value and what is allowed.
  std::function<void(SkyPoint&, std::string_view word)> read_text{};
  std::function<void(SkyPoint&, double number)> read_number{};
};

constexpr char kSeeds[] = "it must be a whole number, 0 to 18446744073709551615";

template <typename F>
Column column_of(const F& field) {
  Column column{field.name};
  if constexpr (std::same_as<ValueOf<F, SkyPoint>, double>) {
    column.read_number = [field](SkyPoint& point, double number) {
      require(field.name, number, field.allowed, field.unit);
      field.set(point, number);
    };
    column.read_text = [field, read = column.read_number](SkyPoint& point, std::string_view word) {
      const auto number = parse_double(word);
      if (!number) {
        throw std::invalid_argument(
            fmt::format("{} is '{}'; it must be a number", field.name, printable(word)));
      }
      read(point, *number);
    };
  } else {
    column.read_text = [field](SkyPoint& point, std::string_view word) {
      const auto number = parse_number<std::uint64_t>(word);
      if (!number) {
        throw std::invalid_argument(fmt::format("{} is '{}'; {}", field.name, printable(word), kSeeds));
      }
      field.set(point, number);
    };
    column.read_number = [field](SkyPoint& point, double number) {
      if (!(number >= 0.0 && number < 0x1p64) || number != std::floor(number)) {
        throw std::invalid_argument(fmt::format("{} is {}; {}", field.name, number, kSeeds));
      }
      field.set(point, std::optional(static_cast<std::uint64_t>(number)));
    };
  }
  return column;
}

// In the order of the table.
std::vector<Column> known_columns() {
  std::vector<Column> columns;
  for_each_field(SkyPoint{},
                 [&](const auto& field, const SkyPoint&) { columns.push_back(column_of(field)); });
  return columns;
}

std::vector<std::string_view> cells_of(std::string_view line) {
  std::vector<std::string_view> cells;
  for (std::size_t begin = 0; begin <= line.size();) {
    const std::size_t end = std::min(line.find(',', begin), line.size());
    cells.push_back(trim(line.substr(begin, end - begin)));
    begin = end + 1;
  }
  return cells;
}

bool must_be_there(std::string_view name) {
  return name == "x" || name == "y" || name == "z";
}

// A column for each name of the first line; empty ones are passed over.
std::vector<Column> columns_of(const TextLines& lines) {
  const std::vector<Column> known = known_columns();
  std::vector<Column> columns;
  std::vector<std::string_view> names = cells_of(lines.line());
  for (const std::string_view name : names) {
    if (std::count(names.begin(), names.end(), name) > 1)
      lines.refuse(fmt::format("column {} is there twice", printable(name)));
    const auto found =
        std::find_if(known.begin(), known.end(), [&](const Column& one) { return one.name == name; });
    if (found != known.end()) {
      columns.push_back(*found);
    } else if (std::find(kPassedOver.begin(), kPassedOver.end(), name) != kPassedOver.end()) {
      columns.push_back({name});
    } else {
      lines.refuse(fmt::format(
          "there is no column '{}'; columns are x, y, z, size, turn, seed, file and scale", printable(name)));
    }
  }
  for (const Column& one : known) {
    if (must_be_there(one.name) && std::find(names.begin(), names.end(), one.name) == names.end())
      lines.refuse(fmt::format("column {} is missing; the first line names the columns", one.name));
  }
  return columns;
}

[[noreturn]] void refuse_many(const std::string& name, const std::string& count) {
  throw std::runtime_error(
      fmt::format("{}: has {} points; a sky has at most {}", name, count, kMostSkyPoints));
}

std::vector<SkyPoint> read_csv(std::string_view text, const std::string& name, const SkyPoint& others) {
  constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf";  // of spreadsheets
  if (text.starts_with(kByteOrderMark)) text.remove_prefix(kByteOrderMark.size());
  TextLines lines(text, name);
  if (!lines.next_filled('#')) throw std::runtime_error(name + ": has no points");
  const std::vector<Column> columns = columns_of(lines);
  std::vector<SkyPoint> points;
  while (lines.next_filled('#')) {
    if (points.size() == kMostSkyPoints) refuse_many(name, fmt::format("more than {}", kMostSkyPoints));
    const std::vector<std::string_view> cells = cells_of(lines.line());
    if (cells.size() != columns.size()) {
      lines.refuse(
          fmt::format("there are {} columns here; the first line names {}", cells.size(), columns.size()));
    }
    SkyPoint& point = points.emplace_back(others);
    for (std::size_t i = 0; i < cells.size(); ++i) {
      if (!columns[i].read_text) continue;
      try {
        columns[i].read_text(point, cells[i]);
      } catch (const std::invalid_argument& error) {
        lines.refuse(fmt::format("column {}: {}", i + 1, error.what()));
      }
    }
  }
  return points;
}

std::vector<SkyPoint> read_ply(const std::filesystem::path& path, const SkyPoint& others) {
  const std::string name = path.string();
  const PolygonMesh mesh = read_mesh(path, Faces::optional).mesh;
  const std::size_t count = mesh.positions.size();
  if (count > kMostSkyPoints) refuse_many(name, std::to_string(count));
  std::vector<SkyPoint> points(count, others);
  for (const Column& column : known_columns()) {
    const VertexProperty* const property = mesh.property(column.name);
    if (!property && !must_be_there(column.name)) continue;
    for (std::size_t i = 0; i < count; ++i) {
      const double number =
          property ? property->values[i] : mesh.positions[i][static_cast<int>(column.name[0] - 'x')];
      try {
        column.read_number(points[i], number);
      } catch (const std::invalid_argument& error) {
        throw std::runtime_error(fmt::format("{}: vertex {}: {}", name, i, error.what()));
      }
    }
  }
  return points;
}

}  // namespace

std::vector<SkyPoint> read_points(const std::filesystem::path& path, const SkyPoint& others) {
  const std::string name = path.string();
  const std::string extension = extension_of(path);
  if (extension != ".csv" && extension != ".ply")
    throw std::runtime_error(name + ": points are read from .csv and .ply");
  std::error_code ignored;  // by which pipes have no size; what cannot be read is said below
  const std::uintmax_t size = std::filesystem::file_size(path, ignored);
  if (!ignored && size > kMostBytes) {
    throw std::runtime_error(
        fmt::format("{}: has {} bytes, more than {} points need", name, size, kMostSkyPoints));
  }
  std::vector<SkyPoint> points =
      extension == ".csv" ? read_csv(read_file(path, kMostBytes), name, others) : read_ply(path, others);
  if (points.empty()) throw std::runtime_error(name + ": has no points");
  return points;
}

std::string points_text(const std::vector<SkyPoint>& points, const std::vector<PlacedFile>& files) {
  std::string text = "x,y,z,size,turn,seed";
  text += files.empty() ? "\n" : ",file,scale\n";
  for (std::size_t i = 0; i < points.size(); ++i) {
    const SkyPoint& p = points[i];
    text += fmt::format("{},{},{},{},{},{}", p.x, p.y, p.z, p.size, p.turn, p.seed.value_or(0));
    text += files.empty() ? "\n" : fmt::format(",{},{}\n", files[i].file, files[i].scale);
  }
  return text;
}

}  // namespace solidnoise

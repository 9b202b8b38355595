#include "solidnoise/geometry/ply_header.h"

#include <array>
#include <set>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include "solidnoise/core/printable.h"
#include "solidnoise/geometry/scalar_type.h"
#include "solidnoise/geometry/text_lines.h"

namespace solidnoise {
namespace {

// The first name of each type is the older one, which every reader knows.
constexpr std::array<std::pair<std::string_view, ScalarType>, 16> kTypeNames{{
    {"char", ScalarType::int8},
    {"uchar", ScalarType::uint8},
    {"short", ScalarType::int16},
    {"ushort", ScalarType::uint16},
    {"int", ScalarType::int32},
    {"uint", ScalarType::uint32},
    {"float", ScalarType::float32},
    {"double", ScalarType::float64},
    {"int8", ScalarType::int8},
    {"uint8", ScalarType::uint8},
    {"int16", ScalarType::int16},
    {"uint16", ScalarType::uint16},
    {"int32", ScalarType::int32},
    {"uint32", ScalarType::uint32},
    {"float32", ScalarType::float32},
    {"float64", ScalarType::float64},
}};

class HeaderReader {
 public:
  HeaderReader(std::string_view bytes, const std::string& name) : bytes_(bytes), lines_(bytes, name) {}

  PlyHeader read() {
    if (!lines_.next() || trim(lines_.line()) != "ply") {
      throw std::runtime_error(fmt::format("{}: is not a PLY file: it does not begin with 'ply'", name()));
    }
    while (lines_.next()) {
      std::string_view text = lines_.line();
      const std::string_view keyword = take_word(text);
      if (keyword == "end_header") return finish();
      read_statement(keyword, text);
    }
    throw std::runtime_error(fmt::format("{}: the file ends within its header", name()));
  }

 private:
  const std::string& name() const { return lines_.name(); }

  void read_statement(std::string_view keyword, std::string_view text) {
    if (keyword == "comment" || keyword == "obj_info") {
      header_.comments.emplace_back(trim(text));
      header_.has_info = header_.has_info || keyword == "obj_info";
    } else if (keyword == "format") {
      read_format(text);
    } else if (keyword == "element") {
      read_element(text);
    } else if (keyword == "property") {
      read_property(text);
    } else if (!keyword.empty()) {
      lines_.refuse(fmt::format("'{}' has no place in the header", printable(keyword)));
    }
  }

  void read_format(std::string_view text) {
    const std::string_view encoding = take_word(text);
    const std::string_view version = take_word(text);
    if (encoding == "ascii") {
      header_.encoding = PlyEncoding::ascii;
    } else if (encoding == "binary_little_endian") {
      header_.encoding = PlyEncoding::binary_little_endian;
    } else if (encoding == "binary_big_endian") {
      header_.encoding = PlyEncoding::binary_big_endian;
    } else {
      lines_.refuse(fmt::format("unknown format '{}'", printable(encoding)));
    }
    if (version != "1.0") lines_.refuse(fmt::format("unknown version '{}'", printable(version)));
    has_format_ = true;
  }

  void read_element(std::string_view text) {
    PlyElement element;
    element.name = take_word(text);
    const std::string_view count = take_word(text);
    const auto number = parse_number<std::uint64_t>(count);
    if (element.name.empty() || !number) {
      lines_.refuse(fmt::format("an element needs a name and a count, not '{}'", printable(count)));
    }
    if (!element_names_.insert(element.name).second) {
      lines_.refuse(fmt::format("there are two elements '{}'", printable(element.name)));
    }
    element.count = *number;
    header_.elements.push_back(std::move(element));
    property_names_.clear();
  }

  void read_property(std::string_view text) {
    if (header_.elements.empty()) lines_.refuse("a property before the first element");
    PlyProperty property;
    const std::string_view type = take_word(text);
    if (type == "list") {
      property.count_type = read_type(take_word(text));
      if (is_float(*property.count_type)) lines_.refuse("the length of a list must be of a type of integers");
      property.type = read_type(take_word(text));
    } else {
      property.type = read_type(type);
    }
    property.name = take_word(text);
    if (property.name.empty()) lines_.refuse("a property needs a name");
    if (!property_names_.insert(property.name).second) {
      lines_.refuse(fmt::format("there are two properties '{}'", printable(property.name)));
    }
    header_.elements.back().properties.push_back(std::move(property));
  }

  ScalarType read_type(std::string_view word) const {
    for (const auto& [type_name, type] : kTypeNames) {
      if (word == type_name) return type;
    }
    lines_.refuse(fmt::format("unknown type '{}'", printable(word)));
  }

  PlyHeader finish() {
    if (!has_format_) {
      throw std::runtime_error(fmt::format("{}: the header does not say the format", name()));
    }
    header_.bytes = bytes_.size() - lines_.rest().size();
    header_.lines = lines_.number();
    return std::move(header_);
  }

  std::string_view bytes_;
  TextLines lines_;
  PlyHeader header_;
  bool has_format_ = false;
  std::set<std::string, std::less<>> element_names_;
  std::set<std::string, std::less<>> property_names_;  // of the last element
};

}  // namespace

std::string_view ply_type_name(ScalarType type) {
  for (const auto& [name, named] : kTypeNames) {
    if (named == type) return name;
  }
  throw std::invalid_argument("unknown scalar type");
}

PlyHeader read_ply_header(std::string_view bytes, const std::string& name) {
  return HeaderReader(bytes, name).read();
}

}  // namespace solidnoise

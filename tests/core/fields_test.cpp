#include "solidnoise/core/fields.h"

#include <limits>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "support/message_of.h"

namespace solidnoise::fields_test {
namespace {

enum class Colour { red, blue };
constexpr Choices<Colour, 2> kColours{{{Colour::red, "red"}, {Colour::blue, "blue"}}};

struct Handle {
  double length = 2.0;
  double from = 0.0;
  double to = 1.0;
};

struct Spoon {
  double width = 3.0;
  std::optional<double> depth{};
  Colour colour = Colour::blue;
  Handle handle{};
};

constexpr auto fields_of(std::type_identity<Handle>) {
  return list_fields(
      field("length", &Handle::length, between(1.0, 4.0), "inches", "From end to end"),
      field("grip", std::array{&Handle::from, &Handle::to}, kFinite, "", "Where the hand goes"));
}

constexpr auto fields_of(std::type_identity<Spoon>) {
  return list_fields(field("width", &Spoon::width, kPositive, "inches", "Across"),
                     field("depth", &Spoon::depth, at_least(0.5), "", "Inside"), part(&Spoon::handle),
                     field("colour", &Spoon::colour, kColours, "As painted"));
}

TEST(Fields, AreVisitedInTheirOrderAndThoseOfAPartInItsPlace) {
  std::vector<std::string> names;
  Spoon spoon;
  for_each_field(spoon, [&](const auto& field, const auto&) { names.emplace_back(field.name); });
  EXPECT_EQ(names, (std::vector<std::string>{"width", "depth", "length", "grip", "colour"}));
}

TEST(Fields, NumbersThatAreOneFieldAreSetTogether) {
  Handle handle{};
  for_each_field(handle, [](const auto& field, auto& owner) {
    if constexpr (requires { field.get(owner).size(); }) field.set(owner, std::array{0.25, 0.75});
  });
  EXPECT_EQ(handle.from, 0.25);
  EXPECT_EQ(handle.to, 0.75);
}

TEST(Fields, NumbersOutOfTheirIntervalAreRefusedByNameValueAndRange) {
  const auto message = [](const Spoon& spoon) {
    return message_of<std::invalid_argument>([&] { require_fields(spoon); });
  };
  EXPECT_NO_THROW(require_fields(Spoon()));
  EXPECT_EQ(message({.width = -1.0}), "width is -1; it must be greater than 0 (inches)");
  EXPECT_EQ(message({.width = 1e308}), "width is 1e+308; it must be at most 1e+30 in size");
  EXPECT_EQ(message({.width = -1e308}), "width is -1e+308; it must be greater than 0 (inches)");
  EXPECT_EQ(message({.depth = 0.25}), "depth is 0.25; it must be at least 0.5");
  EXPECT_EQ(message({.handle = {.length = 5.0}}), "length is 5; it must be between 1 and 4 (inches)");
  EXPECT_EQ(message({.handle = {.to = std::numeric_limits<double>::quiet_NaN()}}),
            "grip is nan; it must be a finite number");
}

}  // namespace
}  // namespace solidnoise::fields_test

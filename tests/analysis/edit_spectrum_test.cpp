#include "solidnoise/analysis/exemplar/edit_spectrum.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <gtest/gtest.h>

namespace solidnoise::edit_spectrum_test {
namespace {

// Two groups in two bands.
GaborSpectrum two_groups() {
  GaborSpectrum spectrum;
  spectrum.groups = {"base", "waves"};
  spectrum.bands = {{0.1, {{{0.2, 0.0, 0.0}, 1.0, 0}, {{0.0, 0.3, 0.0}, 2.0, 1}}},
                    {0.05, {{{0.1, 0.1, 0.0}, 0.5, 1}}}};
  return spectrum;
}

TEST(EditSpectrum, RotatesOneGroup) {
  GaborSpectrum spectrum = two_groups();
  rotate_group(spectrum, "base", 90.0);
  EXPECT_NEAR(spectrum.bands[0].components[0].frequency.x, 0.0, 1e-15);
  EXPECT_NEAR(spectrum.bands[0].components[0].frequency.y, 0.2, 1e-15);
  EXPECT_EQ(spectrum.bands[0].components[1], two_groups().bands[0].components[1]);
  EXPECT_EQ(spectrum.variance(), two_groups().variance());
}

// The density turns with the components.
TEST(EditSpectrum, RotatesTheDensity) {
  GaborSpectrum spectrum = two_groups();
  rotate_group(spectrum, {}, 30.0);
  const double c = std::cos(std::acos(-1.0) / 6.0);
  for (const Vec<3>& f : {Vec<3>(0.2, 0.01, 0.0), Vec<3>(-0.1, 0.25, 0.0)}) {
    const Vec<3> turned(c * f.x - 0.5 * f.y, 0.5 * f.x + c * f.y, 0.0);
    EXPECT_NEAR(spectrum.density(turned), two_groups().density(f), 1e-12);
  }
}

TEST(EditSpectrum, RotatesAboutAnAxisInThreeDimensions) {
  GaborSpectrum spectrum = two_groups();
  spectrum.dimensions = 3;
  rotate_group(spectrum, {}, 90.0, Vec<3>(2.0, 0.0, 0.0));
  EXPECT_NEAR(spectrum.bands[0].components[0].frequency.x, 0.2, 1e-15);
  EXPECT_NEAR(spectrum.bands[0].components[1].frequency.z, 0.3, 1e-15);
}

TEST(EditSpectrum, ScalesAndTranslatesFrequencies) {
  GaborSpectrum spectrum = two_groups();
  scale_group(spectrum, "waves", 2.0);
  translate_group(spectrum, "base", Vec<3>(0.05, -0.1, 0.0));
  EXPECT_EQ(spectrum.bands[0].components[1].frequency.y, 0.6);
  EXPECT_NEAR(spectrum.bands[0].components[0].frequency.x, 0.25, 1e-15);
  EXPECT_NEAR(spectrum.bands[0].components[0].frequency.y, -0.1, 1e-15);
}

TEST(EditSpectrum, ChangesMagnitudesAsAmplitudes) {
  GaborSpectrum spectrum = two_groups();
  scale_magnitude(spectrum, "waves", 3.0);
  EXPECT_DOUBLE_EQ(spectrum.variance(), 1.0 + 9.0 * 2.5);
}

TEST(EditSpectrum, MovesComponentsBetweenBandsOfOneWidth) {
  GaborSpectrum spectrum = two_groups();
  scale_bandwidth(spectrum, "waves", 0.5);
  // 0.1 -> 0.05 and 0.05 -> 0.025; what is not in the group stays.
  ASSERT_EQ(spectrum.bands.size(), 3u);
  EXPECT_EQ(spectrum.bands[0].components.size(), 1u);
  EXPECT_EQ(spectrum.bands[0].components[0].group, 0);
  EXPECT_DOUBLE_EQ(spectrum.bands[1].a, 0.05);
  EXPECT_DOUBLE_EQ(spectrum.bands[2].a, 0.025);
  EXPECT_DOUBLE_EQ(spectrum.variance(), 3.5);
}

TEST(EditSpectrum, RemovesAddsCopiesAndRenames) {
  GaborSpectrum spectrum = two_groups();
  remove_group(spectrum, "base");
  EXPECT_EQ(spectrum.groups, std::vector<std::string>{"waves"});
  EXPECT_DOUBLE_EQ(spectrum.variance(), 2.5);
  EXPECT_NO_THROW(spectrum.validate());

  add_component(spectrum, 0.1, {{0.4, 0.0, 0.0}, 0.25}, "new");
  EXPECT_EQ(spectrum.groups.back(), "new");
  EXPECT_EQ(spectrum.bands[0].components.back().group, 1);

  copy_group(spectrum, two_groups(), "base");
  EXPECT_DOUBLE_EQ(spectrum.variance(), 3.75);
  EXPECT_EQ(spectrum.groups.back(), "base");
  copy_group(spectrum, two_groups(), {});
  EXPECT_EQ(spectrum.groups.size(), 3u);
  EXPECT_DOUBLE_EQ(spectrum.variance(), 7.25);

  rename_group(spectrum, "new", "waves");
  EXPECT_EQ(spectrum.groups, (std::vector<std::string>{"waves", "base"}));
  EXPECT_NO_THROW(spectrum.validate());
}

TEST(EditSpectrum, RefusesWhatCannotBe) {
  GaborSpectrum spectrum = two_groups();
  EXPECT_THROW(rotate_group(spectrum, "nothing", 10.0), std::invalid_argument);
  EXPECT_THROW(scale_group(spectrum, {}, 0.0), std::invalid_argument);
  EXPECT_THROW(scale_magnitude(spectrum, {}, 0.0), std::invalid_argument);  // nothing would be left
  EXPECT_THROW(scale_magnitude(spectrum, {}, -1.0), std::invalid_argument);
  EXPECT_THROW(scale_bandwidth(spectrum, {}, -1.0), std::invalid_argument);
  EXPECT_THROW(translate_group(spectrum, {}, Vec<3>(0.0, 0.0, 1.0)), std::invalid_argument);
  EXPECT_THROW(add_component(spectrum, 0.1, {{0.0, 0.0, 0.0}, -1.0}, "x"), std::invalid_argument);
  GaborSpectrum other = two_groups();
  other.isotropic = true;
  EXPECT_THROW(copy_group(spectrum, other, {}), std::invalid_argument);
  EXPECT_THROW(rotate_group(other, {}, 10.0), std::invalid_argument);
  EXPECT_EQ(spectrum, two_groups());  // none of them changed anything
}

// A broad ring of directions, a row of components along 40 degrees, a single narrow peak.
TEST(GroupSpectrum, FindsThePartsOfAWoldDecomposition) {
  GaborSpectrum spectrum;
  spectrum.bands = {{0.1, {}}, {0.01, {}}};
  const double degree = std::acos(-1.0) / 180.0;
  for (int i = 0; i < 36; ++i) {
    const double angle = (5.0 * i + 2.5) * degree;
    spectrum.bands[0].components.push_back({{0.3 * std::cos(angle), 0.3 * std::sin(angle), 0.0}, 1.0});
  }
  for (int i = 1; i <= 6; ++i) {
    const double f = 0.04 * i;
    spectrum.bands[1].components.push_back(
        {{f * std::cos(40.0 * degree), f * std::sin(40.0 * degree), 0.0}, 3.0});
  }
  GaborSpectrum grouped = group_spectrum(spectrum);
  // Every one of the row is a narrow peak above its surroundings as well: together they are 18 of 54.
  const int periodic = find_group(grouped, "periodic");
  for (const SpectrumComponent& component : grouped.bands[1].components) EXPECT_EQ(component.group, periodic);
  EXPECT_NO_THROW(find_group(grouped, "stochastic"));

  // The same row in wide Gaussians is no peak but a direction.
  spectrum.bands[1].a = 0.081;
  for (SpectrumComponent& component : spectrum.bands[1].components) component.variance = 6.0;
  grouped = group_spectrum(spectrum);
  const int row = find_group(grouped, "anisotropic");
  EXPECT_EQ(grouped.bands[1].components.back().group, row);
  EXPECT_EQ(grouped.bands[0].components[20].group, find_group(grouped, "stochastic"));
  EXPECT_NO_THROW(grouped.validate());
}

// Furrows of bark: 2.4 times as much power within 20 degrees as elsewhere, and nothing where all directions
// are alike.
TEST(GroupSpectrum, FindsADirectionThatHoldsTwiceItsShare) {
  for (const double power : {1.0, 2.4}) {
    GaborSpectrum spectrum;
    spectrum.bands = {{0.1, {}}};
    const double degree = std::acos(-1.0) / 180.0;
    for (int i = 0; i < 36; ++i) {
      const double angle = (5.0 * i + 2.5) * degree;
      const bool along = i >= 6 && i < 10;
      spectrum.bands[0].components.push_back(
          {{0.3 * std::cos(angle), 0.3 * std::sin(angle), 0.0}, along ? power : 1.0});
    }
    const GaborSpectrum grouped = group_spectrum(spectrum);
    const auto& groups = grouped.groups;
    EXPECT_EQ(std::ranges::find(groups, "anisotropic") != groups.end(), power > 1.0);
    if (power > 1.0) {
      EXPECT_EQ(grouped.bands[0].components[8].group, find_group(grouped, "anisotropic"));
    }
  }
}

TEST(EditSpectrum, SelectsComponentsByFrequencyAndDirection) {
  GaborSpectrum spectrum;
  spectrum.bands = {{0.1, {{{1.0, 0.1, 0.0}, 1.0}, {{-0.1, -1.0, 0.0}, 1.0}, {{0.0, 3.0, 0.0}, 1.0}}}};
  select_group(spectrum, {}, {.from = 0.5, .to = 2.0, .direction = 90.0, .spread = 20.0}, "steep");
  const auto& components = spectrum.bands[0].components;
  EXPECT_EQ(spectrum.groups, (std::vector<std::string>{"all", "steep"}));
  EXPECT_EQ(components[0].group, 0);
  EXPECT_EQ(components[1].group, 1);  // of the opposite sign
  EXPECT_EQ(components[2].group, 0);
  EXPECT_EQ(select_group(spectrum, {}, {.from = 5.0, .to = 6.0}, "none"), 0);
}

}  // namespace
}  // namespace solidnoise::edit_spectrum_test

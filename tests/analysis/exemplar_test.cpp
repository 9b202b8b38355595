#include "solidnoise/analysis/exemplar/exemplar.h"

#include <array>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <limits>
#include <stdexcept>
#include <string>

#include <gtest/gtest.h>

#include "solidnoise/analysis/exemplar/exemplar_patches.h"
#include "solidnoise/analysis/exemplar/fit_exemplar.h"
#include "solidnoise/analysis/exemplar/gaussian_field.h"
#include "solidnoise/core/random.h"
#include "solidnoise/image/color.h"
#include "solidnoise/image/image_file.h"
#include "support/message_of.h"
#include "support/paths.h"
#include "support/temporary_folder.h"

namespace solidnoise::exemplar_test {
namespace {

Image random_image(int width, int height, int channels) {
  Image image(width, height, channels);
  RandomStream stream(4);
  for (float& value : image.pixels) value = static_cast<float>(stream.next_unit());
  return image;
}

std::string refusal(const Image& image) {
  return message_of<std::invalid_argument>([&] { exemplar_of_image(image, {}, "it"); });
}

TEST(Exemplar, IsThePictureInLinearLightWithYUp) {
  const Image image = random_image(20, 17, 3);
  const Exemplar<2> exemplar = exemplar_of_image(image, {.pixel_size = 0.5}, "it");
  ASSERT_EQ(exemplar.channels.size(), 3u);
  EXPECT_EQ(exemplar.shape().count, glm::ivec2(20, 17));
  EXPECT_EQ(exemplar.shape().step, Vec<2>(0.5));
  // Pixel (3, 2) from the top is sample (3, 14) from the bottom.
  EXPECT_EQ(exemplar.channels[1].values[3 * 17 + 14], linear_from_srgb(image.at(3, 2, 1)));
  const Exemplar<2> raw = exemplar_of_image(image, {.raw_values = true}, "it");
  EXPECT_EQ(raw.channels[1].values[3 * 17 + 14], image.at(3, 2, 1));
  EXPECT_EQ(image_of_exemplar(raw).pixels, image.pixels);
}

TEST(Exemplar, OfEqualChannelsIsGrey) {
  Image image = random_image(16, 16, 3);
  for (int i = 0; i < 256; ++i) {
    for (int c = 1; c < 3; ++c) image.at(i % 16, i / 16, c) = image.at(i % 16, i / 16, 0);
  }
  EXPECT_EQ(exemplar_of_image(image, {}, "it").channels.size(), 1u);
}

TEST(Exemplar, MayHaveAnAlphaChannelThatIsOne) {
  Image image = random_image(16, 16, 4);
  for (int i = 0; i < 256; ++i) image.at(i % 16, i / 16, 3) = 1.0f;
  EXPECT_EQ(exemplar_of_image(image, {}, "it").channels.size(), 3u);
  image.at(5, 6, 3) = 0.5f;
  EXPECT_NE(refusal(image).find("it: has an alpha channel, which is 0.5 at (5, 6)"), std::string::npos);
}

TEST(Exemplar, RefusesWhatHoldsNoTexture) {
  EXPECT_NE(refusal(random_image(15, 40, 1)).find("15 samples along an axis"), std::string::npos);
  EXPECT_NE(refusal(Image(32, 32, 3)).find("is constant"), std::string::npos);
  EXPECT_NE(refusal(random_image(32, 32, 5)).find("5 channels"), std::string::npos);
  Image image = random_image(32, 32, 1);
  image.at(3, 3) = std::numeric_limits<float>::quiet_NaN();
  EXPECT_NE(refusal(image).find("not finite"), std::string::npos);
}

TEST(Exemplar, IsReadFromFiles) {
  const TemporaryFolder folder;
  const Image image = random_image(24, 18, 3);
  write_image(folder / "a.png", image, {.sample_type = SampleType::uint16});
  const Exemplar<2> decoded = read_exemplar(folder / "a.png");
  EXPECT_NEAR(decoded.channels[0].values[17], linear_from_srgb(image.at(0, 0, 0)), 1e-4);
  write_image(folder / "a.exr", image, {.color_space = ColorSpace::linear});
  EXPECT_EQ(read_exemplar(folder / "a.exr").channels[0].values[17], image.at(0, 0, 0));  // is linear
  EXPECT_THROW(read_exemplar(folder / "none.png"), std::runtime_error);
}

// Odd and oblong exemplars are cut to 60 x 36; the model's channels have the periodograms'
// variances.
TEST(FitExemplar, MakesAModelOfAnyShape) {
  const Exemplar<2> exemplar = exemplar_of_image(random_image(61, 37, 3), {}, "it");
  const ExemplarFit<2> fit = fit_exemplar<2>(std::vector{exemplar});
  EXPECT_EQ(fit.count, glm::ivec2(60, 36));
  ASSERT_EQ(fit.model.channels.size(), 3u);
  EXPECT_NO_THROW(fit.model.validate());
  ASSERT_TRUE(fit.dependence);
  EXPECT_LE(fit.dependence->independent, fit.dependence->pca * (1.0 + 1e-9));
}

// What a stranger would measure: means and covariances of the colours, of the photograph and of its noise,
// and variances of the colours' differences, which are much smaller.
void expect_colors(const ExemplarModel& model, const Exemplar<2>& exemplar) {
  const auto mean_of = [&](const auto& value) {
    double sum = 0.0;
    for (std::size_t p = 0; p < exemplar.channels[0].size(); ++p) sum += value(p);
    return sum / static_cast<double>(exemplar.channels[0].size());
  };
  const auto at = [&](int color, std::size_t p) {
    return static_cast<double>(exemplar.channels[static_cast<std::size_t>(color)].values[p]);
  };
  std::array<double, 3> mean;
  for (int i = 0; i < 3; ++i)
    mean[static_cast<std::size_t>(i)] = mean_of([&](std::size_t p) { return at(i, p); });
  const auto covariance = [&](int i, int j) {
    return mean_of([&](std::size_t p) {
      return (at(i, p) - mean[static_cast<std::size_t>(i)]) * (at(j, p) - mean[static_cast<std::size_t>(j)]);
    });
  };
  const auto made = [&](int i, int j) {
    double sum = 0.0;
    for (std::size_t k = 0; k < 3; ++k)
      sum += model.channels[k].variance() * model.axes[k][i] * model.axes[k][j];
    return model.squares ? 2.0 * sum * sum + 4.0 * model.mean[i] * model.mean[j] * sum : sum;
  };
  for (int i = 0; i < 3; ++i) {
    double made_mean = model.mean[i];
    if (model.squares) {
      made_mean *= made_mean;
      for (std::size_t k = 0; k < 3; ++k)
        made_mean += model.channels[k].variance() * std::pow(model.axes[k][i], 2);
    }
    EXPECT_NEAR(made_mean, mean[static_cast<std::size_t>(i)], 0.01 * std::sqrt(covariance(i, i)));
    for (int j = 0; j < 3; ++j) {
      EXPECT_NEAR(made(i, j), covariance(i, j), 0.01 * std::sqrt(covariance(i, i) * covariance(j, j)));
      if (i == j) continue;
      const double difference = covariance(i, i) + covariance(j, j) - 2.0 * covariance(i, j);
      EXPECT_NEAR(made(i, i) + made(j, j) - 2.0 * made(i, j), difference, 0.01 * difference)
          << i << " - " << j;
    }
  }
}

// Coarse: colours do not depend on it.
ExemplarFit<2> fit_coarsely(const Exemplar<2>& exemplar, bool squares = false) {
  ExemplarFitOptions options;
  options.raw_values = true;
  options.squares = squares;
  options.spectrum.kappa = 0.9;
  return fit_exemplar<2>(std::vector{exemplar}, options);
}

// Of every photograph that ships, in linear light, as it is stored, and of squares.
TEST(FitExemplar, HasTheColorsOfEveryPhotograph) {
  for (const auto& file : std::filesystem::directory_iterator(in_source("examples/exemplars"))) {
    if (file.path().extension() != ".jpg") continue;
    for (const bool raw_values : {false, true}) {
      SCOPED_TRACE(testing::Message() << file.path().filename() << (raw_values ? " raw" : " linear"));
      const Exemplar<2> exemplar = read_exemplar(file.path(), {.raw_values = raw_values});
      const ExemplarFit<2> fit = fit_coarsely(exemplar);
      EXPECT_LE(fit.dependence->independent, fit.dependence->pca);
      expect_colors(fit.model, exemplar);
      if (raw_values) expect_colors(fit_coarsely(exemplar, true).model, exemplar);
    }
  }
}

// Four photographs in one, whose patches overlap and so hold its middle more often than its corners; and one
// of which a part is left out, for its sides are no fast counts.
TEST(FitExemplar, HasTheColorsOfWhatIsCutIntoPatches) {
  const auto photograph = [](const char* name) {
    return read_exemplar(in_source("examples/exemplars/") + name, {.raw_values = true});
  };
  const std::array parts{photograph("soil.jpg"), photograph("moss.jpg"), photograph("leaves.jpg"),
                         photograph("sand.jpg")};
  Exemplar<2> mosaic;
  for (std::size_t c = 0; c < 3; ++c) {
    DenseField<2>& channel = mosaic.channels.emplace_back(glm::ivec2(512), Vec<2>(1.0));
    const ArrayShape<2> whole{channel.count};
    for (std::size_t i = 0; i < channel.size(); ++i) {
      const glm::ivec2 at = whole.position(i);
      const DenseField<2>& part = parts[static_cast<std::size_t>(at.x / 256 + at.y / 256 * 2)].channels[c];
      channel.values[i] = part.values[ArrayShape<2>{part.count}.index(at % 256)];
    }
  }
  expect_colors(fit_coarsely(mosaic).model, mosaic);

  Exemplar<2> cut;
  for (const DenseField<2>& channel : parts[2].channels)
    cut.channels.push_back(cut_patch(channel, glm::ivec2(3, 2), glm::ivec2(157, 143)));
  expect_colors(fit_coarsely(cut).model, cut);
}

// Of a slope, in which red and blue differ, periodic components are without.
TEST(FitExemplar, HasTheColorsOfASlope) {
  for (std::uint64_t seed = 0; seed < 8; ++seed) {
    RandomStream stream(seed);
    Image image(64, 64, 3);
    for (int y = 0; y < 64; ++y) {
      for (int x = 0; x < 64; ++x) {
        const auto grey = static_cast<float>(stream.next_unit());
        const auto green = static_cast<float>(stream.next_unit());
        image.at(x, y, 0) = grey + 0.002f * static_cast<float>(x);
        image.at(x, y, 1) = grey + 0.1f * green;
        image.at(x, y, 2) = grey - 0.001f * static_cast<float>(y);
      }
    }
    const Exemplar<2> exemplar = exemplar_of_image(image, {.raw_values = true}, "it");
    SCOPED_TRACE(seed);
    expect_colors(fit_coarsely(exemplar).model, exemplar);
  }
}

// Colours along one line: two channels hold nothing.
TEST(FitExemplar, ToleratesChannelsWithoutAnything) {
  Image image = random_image(32, 32, 3);
  for (int i = 0; i < 1024; ++i) {
    const float value = image.at(i % 32, i / 32, 0);
    image.at(i % 32, i / 32, 1) = 0.25f + 0.5f * value;
    image.at(i % 32, i / 32, 2) = 0.5f;
  }
  const ExemplarFit<2> fit =
      fit_exemplar<2>(std::vector{exemplar_of_image(image, {.raw_values = true}, "it")});
  EXPECT_NO_THROW(fit.model.validate());
  EXPECT_LT(fit.model.channels[2].variance(), 1e-10 * fit.model.channels[0].variance());
}

// Axes of nothing are not turned with those that have something: their spectra are rounding.
TEST(FitExemplar, TakesPicturesOfTwoColors) {
  Image image = random_image(48, 48, 3);
  for (int i = 0; i < 48 * 48; ++i) {
    const bool light = image.at(i % 48, i / 48, 0) > 0.7f;
    const std::array<float, 3> color =
        light ? std::array{217.0f, 195.0f, 173.0f} : std::array{38.0f, 34.0f, 31.0f};
    for (int c = 0; c < 3; ++c) image.at(i % 48, i / 48, c) = color[static_cast<std::size_t>(c)] / 255.0f;
  }
  const Exemplar<2> exemplar = exemplar_of_image(image, {.raw_values = true}, "it");
  const ExemplarFit<2> fit = fit_exemplar<2>(std::vector{exemplar});
  EXPECT_NO_THROW(fit.model.validate());
  ASSERT_TRUE(fit.dependence);
  EXPECT_TRUE(std::isfinite(fit.dependence->independent));
  expect_colors(fit.model, exemplar);
}

struct StopsAfter final : Progress {
  explicit StopsAfter(int questions) : left(questions) {}
  void advance(std::uint64_t, std::uint64_t) override {}
  bool cancelled() override { return left-- <= 0; }
  std::atomic<int> left;
};

TEST(FitExemplar, KeepsWhatItHasWhenItIsStopped) {
  const std::vector exemplars{exemplar_of_image(random_image(32, 32, 3), {}, "it")};
  StopsAfter measured(2);  // as often as the picture is gone through
  const ExemplarFit<2> fit = fit_exemplar<2>(exemplars, {}, &measured);
  EXPECT_TRUE(fit.interrupted);
  EXPECT_NO_THROW(fit.model.validate());
  for (const int questions : {0, 1}) {
    StopsAfter measuring(questions);
    EXPECT_THROW(fit_exemplar<2>(exemplars, {}, &measuring), Cancelled) << questions;
  }
}

DenseField<2> low_pass_field(std::uint64_t seed) {
  PowerSpectrum<2> density;
  density.count = glm::ivec2(96, 80);
  density.density.resize(96 * 80);
  for (std::size_t i = 0; i < density.density.size(); ++i) {
    const Vec<2> f = density.frequency(i);
    density.density[i] = std::exp(-(f.x * f.x + f.y * f.y) / 0.02);
  }
  return gaussian_field(density, seed);
}

// Of a Gaussian texture the report's numbers are scatter: 8 of them without a warning, where one by chance is
// a matter of more than 5 deviations.
TEST(Gaussianity, AcceptsGaussianTextures) {
  for (std::uint64_t seed = 0; seed < 8; ++seed) {
    const GaussianityReport report = test_gaussianity(low_pass_field(seed));
    EXPECT_TRUE(report.warnings.empty());
    EXPECT_LT(std::abs(report.structure), 0.5);
    EXPECT_LT(report.unevenness, 1.5);
  }
}

TEST(Gaussianity, WarnsOfBricksPatchesAndLopsidedValues) {
  DenseField<2> bricks(glm::ivec2(96), Vec<2>(1.0));
  RandomStream stream(2);
  for (int x = 0; x < 96; ++x) {
    for (int y = 0; y < 96; ++y) {
      const int shifted = (x + (y / 8 % 2) * 8) % 16;
      const bool mortar = shifted == 0 || y % 8 == 0;
      bricks.values[static_cast<std::size_t>(96 * x + y)] =
          static_cast<float>((mortar ? 1.0 : 0.2) + 0.05 * stream.next_unit());
    }
  }
  const GaussianityReport structured = test_gaussianity(bricks);
  EXPECT_FALSE(structured.warnings.empty());
  EXPECT_GT(std::abs(structured.structure), 1.0);

  // Furrows: the magnitude of a Gaussian texture, sharp where it is 0.
  DenseField<2> furrows = low_pass_field(4);
  for (float& value : furrows.values) value = std::abs(value);
  EXPECT_FALSE(test_gaussianity(furrows).warnings.empty());

  // Grain in round patches alone, as leaves have veins.
  DenseField<2> patches = low_pass_field(3);
  for (int x = 0; x < 96; ++x) {
    for (int y = 0; y < 80; ++y) {
      if (std::hypot(x % 40 - 20, y % 40 - 20) > 12.0)
        patches.values[static_cast<std::size_t>(80 * x + y)] *= 0.2f;
    }
  }
  EXPECT_GT(test_gaussianity(patches).unevenness, 2.0);

  DenseField<2> exponential = low_pass_field(1);
  for (float& value : exponential.values) value = std::exp(20.0f * value);
  const GaussianityReport lopsided = test_gaussianity(exponential);
  EXPECT_GT(lopsided.skewness, 1.0);
  EXPECT_FALSE(lopsided.warnings.empty());
}

}  // namespace
}  // namespace solidnoise::exemplar_test

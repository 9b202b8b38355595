#include "solidnoise/render/render_mesh.h"

#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "support/message_of.h"

namespace solidnoise::render_mesh_test {
namespace {

// A sphere of latitudes and longitudes, with its normals.
struct Ball {
  PolygonMesh mesh;
  std::vector<Vec<3>> normals;

  explicit Ball(const Vec<3>& centre = Vec<3>(0.0), double radius = 1.0) {
    constexpr std::uint32_t kRings = 24;
    constexpr std::uint32_t kSpokes = 48;
    for (std::uint32_t ring = 0; ring <= kRings; ++ring) {
      for (std::uint32_t spoke = 0; spoke < kSpokes; ++spoke) {
        const double polar = std::numbers::pi * ring / kRings;
        const double turn = 2.0 * std::numbers::pi * spoke / kSpokes;
        normals.emplace_back(std::sin(polar) * std::cos(turn), std::cos(polar),
                             std::sin(polar) * std::sin(turn));
        mesh.positions.push_back(centre + radius * normals.back());
      }
    }
    for (std::uint32_t ring = 0; ring < kRings; ++ring) {
      for (std::uint32_t spoke = 0; spoke < kSpokes; ++spoke) {
        const std::uint32_t next = (spoke + 1) % kSpokes;
        mesh.add_face(std::vector<std::uint32_t>{ring * kSpokes + spoke, ring * kSpokes + next,
                                                 (ring + 1) * kSpokes + next, (ring + 1) * kSpokes + spoke});
      }
    }
  }

  Image picture(const Color& color, const MeshPictureOptions& options = {.width = 96, .height = 96}) const {
    return render_mesh(mesh, normals, std::vector<Color>(mesh.positions.size(), color), options);
  }
};

TEST(RenderMesh, ShowsTheColorsOfTheVertices) {
  const Image red = Ball().picture({0.8f, 0.0f, 0.0f});
  EXPECT_GT(red.at(48, 48, 0), 0.4f);
  EXPECT_LT(red.at(48, 48, 1), 0.01f);
  const Image black = Ball().picture({0.0f, 0.0f, 0.0f});
  EXPECT_EQ(black.at(48, 48, 0), 0.0f);
}

TEST(RenderMesh, FillsThePictureWhereverTheMeshIsAndHoweverLarge) {
  for (const double size : {1e-6, 1.0, 1e6}) {
    const Image picture = Ball(Vec<3>(1e3, -2e3, 3e3) * size, size).picture({0.0f, 0.0f, 0.0f});
    int black = 0;
    for (int y = 0; y < picture.height; ++y) {
      for (int x = 0; x < picture.width; ++x) {
        black += picture.at(x, y, 0) + picture.at(x, y, 1) + picture.at(x, y, 2) == 0.0f;
      }
    }
    // A ball that touches a square's sides covers pi / 4 of it; with the margin of 1.08, 0.67.
    EXPECT_NEAR(black / (96.0 * 96.0), 0.67, 0.05) << size;
    EXPECT_GT(picture.at(0, 0, 0), 0.1f);
  }
}

TEST(RenderMesh, IsBrighterAboveThanBelow) {
  const Image picture = Ball().picture({0.5f, 0.5f, 0.5f});
  EXPECT_GT(picture.at(36, 24, 1), 1.5f * picture.at(60, 80, 1));
  const Image z_up = Ball().picture({0.5f, 0.5f, 0.5f}, {.width = 96, .height = 96, .up = UpAxis::z});
  EXPECT_GT(z_up.at(36, 24, 1), 1.5f * z_up.at(60, 80, 1));
}

// A grey of half the code's range looks like one; white is not burnt out.
TEST(RenderMesh, ShowsColorsAsBrightAsTheyAre) {
  constexpr float kMiddleGrey = 0.2140f;  // 0.5 in sRGB
  const Image grey = Ball().picture(Color(kMiddleGrey));
  EXPECT_NEAR(grey.at(40, 34, 1), 0.5f, 0.06f);  // between what faces the sun and what faces the camera
  const Image white = Ball().picture(Color(1.0f));
  int burnt = 0;
  for (int y = 0; y < white.height; ++y) {
    for (int x = 0; x < white.width; ++x) burnt += white.at(x, y, 1) > 0.99f;
  }
  EXPECT_LT(burnt, 96 * 96 / 100);
}

// A black ball, of which the ground shows a shadow, to the right: the sun is on the left.
TEST(RenderMesh, CastsAShadowOnTheGround) {
  const Image picture = Ball().picture(Color(0.0f), {.width = 96, .height = 96, .elevation = 40.0});
  EXPECT_LT(picture.at(90, 70, 1), 0.8f * picture.at(5, 70, 1));
}

TEST(RenderMesh, TurnsTheCamera) {
  Ball ball;
  std::vector<Color> colors;  // red in front of +z, blue behind
  for (const Vec<3>& p : ball.mesh.positions)
    colors.emplace_back(p.z > 0.0 ? Color(1, 0, 0) : Color(0, 0, 1));
  const auto middle = [&](double turn) {
    const Image picture =
        render_mesh(ball.mesh, ball.normals, colors, {.width = 96, .height = 96, .turn = turn});
    return picture.at(48, 48, 0) - picture.at(48, 48, 2);
  };
  EXPECT_GT(middle(0.0), 0.2f);
  EXPECT_LT(middle(180.0), -0.2f);
}

TEST(RenderMesh, DoesNotDependOnTheNumberOfThreads) {
  const Image many = Ball().picture({0.5f, 0.4f, 0.3f});
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  EXPECT_EQ(Ball().picture({0.5f, 0.4f, 0.3f}).pixels, many.pixels);
}

TEST(RenderMesh, LeavesOutWhatIsNotFinite) {
  Ball ball;
  ball.mesh.positions[100].x = std::numeric_limits<double>::quiet_NaN();
  EXPECT_GT(ball.picture({0.5f, 0.5f, 0.5f}).at(48, 48, 1), 0.1f);
  EXPECT_NO_THROW(render_mesh({}, {}, {}, {.width = 16, .height = 16}));
}

TEST(RenderMesh, RefusesWhatDoesNotFit) {
  const Ball ball;
  EXPECT_EQ(message_of<std::invalid_argument>([&] { render_mesh(ball.mesh, ball.normals, {}); }),
            "colors are 0; there must be one for each of the 1200 vertices");
  EXPECT_THROW(ball.picture({}, {.width = 1}), std::invalid_argument);
}

}  // namespace
}  // namespace solidnoise::render_mesh_test

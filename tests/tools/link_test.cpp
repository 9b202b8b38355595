#include <string>

#include <gtest/gtest.h>

#include "tools/run_vdbnoise.h"

namespace solidnoise::link_test {
namespace {

// {"solidnoise":2,"noise":{"type":"kensler","frequency":3}} in base64 for addresses.
constexpr char kCode[] = "eyJzb2xpZG5vaXNlIjoyLCJub2lzZSI6eyJ0eXBlIjoia2Vuc2xlciIsImZyZXF1ZW5jeSI6M319";

TEST(RecipeLink, IsReadAsTheRecipeInIt) {
  for (const char* around : {"#recipe=", "#view=slice&recipe="}) {
    const ToolResult result = run_vdbnoise(
        {"--describe", "--recipe", "http://localhost:8765/" + std::string(around) + kCode + "&plane=0_0_0"});
    ASSERT_EQ(result.status, 0) << result.err;
    EXPECT_NE(result.out.find("\"kensler\""), std::string::npos);
    EXPECT_NE(result.out.find("\"frequency\": 3.0"), std::string::npos);
  }
}

TEST(RecipeLink, IsRefusedWhereItHasNoneOrIsCut) {
  const ToolResult none = run_vdbnoise({"--describe", "--recipe", "http://localhost/#view=slice"});
  EXPECT_EQ(none.status, 1);
  EXPECT_NE(none.err.find("the link has no recipe"), std::string::npos) << none.err;
  const ToolResult cut = run_vdbnoise(
      {"--describe", "--recipe", "http://localhost/#recipe=" + std::string(kCode).substr(0, 40)});
  EXPECT_EQ(cut.status, 1);
  EXPECT_NE(cut.err.find("the link's recipe: line 1, column "), std::string::npos) << cut.err;
  const ToolResult damaged = run_vdbnoise({"--describe", "--recipe", "http://localhost/#recipe=%7B"});
  EXPECT_EQ(damaged.status, 1);
  EXPECT_NE(damaged.err.find("damaged"), std::string::npos) << damaged.err;
}

}  // namespace
}  // namespace solidnoise::link_test

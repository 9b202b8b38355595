#include "solidnoise/volume/vdb/grid_file.h"

#include <stdexcept>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "solidnoise/recipe/field_json.h"
#include "solidnoise/volume/vdb/vdb_write.h"
#include "support/message_of.h"
#include "support/temporary_folder.h"

namespace solidnoise::grid_file_test {
namespace {

TEST(ParseGridFile, SplitsFileAndGrid) {
  EXPECT_EQ(parse_grid_file("a.vdb"), (GridFile{"a.vdb"}));
  EXPECT_EQ(parse_grid_file("a.vdb:heat"), (GridFile{"a.vdb", "heat"}));
  EXPECT_EQ(parse_grid_file("A.VDB:Heat"), (GridFile{"A.VDB", "Heat"}));
  EXPECT_EQ(parse_grid_file("b.vdb/a.vdb:two words"), (GridFile{"b.vdb/a.vdb", "two words"}));
  EXPECT_EQ(parse_grid_file("a:b.vdb"), (GridFile{"a:b.vdb"}));
  EXPECT_EQ(parse_grid_file("a.vdb:x:y"), (GridFile{"a.vdb", "x:y"}));
  EXPECT_EQ(parse_grid_file("a.vdb:heat.vdb:x"), (GridFile{"a.vdb:heat.vdb", "x"}));
  for (const char* const text : {"", ".vdb", ".vdb:x", "a.vdb:", "a.obj", "a", "a.vdbx"}) {
    EXPECT_EQ(parse_grid_file(text), std::nullopt) << text;
  }
}

TEST(ReadGridFile, NotesTheDigestAndRefusesAnotherFile) {
  const TemporaryFolder folder;
  const auto grid = openvdb::FloatGrid::create(0.0f);
  grid->setName("heat");
  grid->tree().setValueOn(openvdb::Coord(1), 2.0f);
  const std::string path = folder / "a.vdb";
  write_vdb(path, {grid}, {});
  GridFile source{path, "heat"};
  EXPECT_EQ(read_grid(source, "--mask")->getName(), "heat");
  EXPECT_EQ(source.digest, file_digest(path));
  EXPECT_EQ(read_float_grid(source, "--mask")->tree().getValue(openvdb::Coord(1)), 2.0f);
  source.digest = "0123456789abcdef";
  const auto refusal = message_of<std::runtime_error>([&] { read_grid(source, "--mask"); });
  EXPECT_NE(refusal.find("a.vdb: is not the file that the recipe was made with"), std::string::npos)
      << refusal;
  EXPECT_NE(refusal.find("name it as --mask"), std::string::npos) << refusal;
}

TEST(GridFileJson, ReadsBackWhatItWrote) {
  for (const GridFile& source : {GridFile{"a.vdb"}, GridFile{"a.vdb", "heat", "0123456789abcdef"}}) {
    Json json;
    json["mask"] = json_of(source);
    JsonReader reader(json);
    std::optional<GridFile> read;
    read_value(reader, "mask", read);
    reader.finish();
    EXPECT_EQ(read, source);
  }
}

TEST(GridFileJson, NamesThePlaceOfWhatIsWrong) {
  const auto refusal = [](const char* text) {
    const Json json = parse_json(text);
    return message_of<std::invalid_argument>([&] {
      JsonReader reader(json);
      std::optional<GridFile> source;
      read_value(reader, "mask", source);
    });
  };
  EXPECT_EQ(refusal(R"({"mask": {}})"), "mask.file is empty; it must be a .vdb");
  EXPECT_EQ(refusal(R"({"mask": {"file": 3}})"), "mask.file is 3; it must be a text");
  EXPECT_EQ(refusal(R"({"mask": {"file": "a.vdb", "gird": "x"}})"),
            "mask.gird is unknown; did you mean grid?");
  EXPECT_EQ(refusal(R"({"mask": "a.vdb"})"), "mask is \"a.vdb\"; it must be an object");
}

}  // namespace
}  // namespace solidnoise::grid_file_test

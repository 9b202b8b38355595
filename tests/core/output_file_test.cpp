#include "solidnoise/core/output_file.h"

#include <filesystem>
#include <ostream>
#include <stdexcept>
#include <string>

#include <gtest/gtest.h>

#include "support/message_of.h"
#include "support/temporary_folder.h"

namespace solidnoise::output_file_test {
namespace {

namespace fs = std::filesystem;

void write_text(const fs::path& path, const std::string& text, OutputOptions options = {}) {
  write_output(path, options, [&](std::ostream& stream) { stream << text; });
}

TEST(WriteOutput, WritesAFileUnderItsNameOnly) {
  const TemporaryFolder folder;
  write_text(folder.path() / "a.txt", "some text");
  EXPECT_EQ(folder.read("a.txt"), "some text");
  EXPECT_EQ(folder.names(), std::set<std::string>{"a.txt"});
}

TEST(WriteOutput, ReplacesAFileOnlyIfToldTo) {
  const TemporaryFolder folder;
  folder.write("a.txt", "old");
  EXPECT_THROW(write_text(folder.path() / "a.txt", "new"), OutputExists);
  EXPECT_EQ(folder.read("a.txt"), "old");
  write_text(folder.path() / "a.txt", "new", {.existing = Existing::replace});
  EXPECT_EQ(folder.read("a.txt"), "new");
}

TEST(WriteOutput, LeavesNothingWhereTheWriterOrTheVerifierThrows) {
  const TemporaryFolder folder;
  folder.write("kept.txt", "old");
  const auto failing = [](std::ostream& stream) {
    stream << std::string(5 << 20, 'x');
    throw std::runtime_error("no more");
  };
  for (const char* name : {"a.txt", "kept.txt"}) {
    EXPECT_EQ(message_of<std::runtime_error>(
                  [&] { write_output(folder.path() / name, {.existing = Existing::replace}, failing); }),
              "no more");
    OutputOptions verified{.existing = Existing::replace};
    verified.verify = [](const fs::path&) { throw std::runtime_error("not what it should be"); };
    EXPECT_EQ(message_of<std::runtime_error>([&] { write_text(folder.path() / name, "x", verified); }),
              "not what it should be");
  }
  EXPECT_EQ(folder.read("kept.txt"), "old");
  EXPECT_EQ(folder.names(), std::set<std::string>{"kept.txt"});
}

TEST(WriteOutput, VerifiesTheWholeFileBeforeItHasItsName) {
  const TemporaryFolder folder;
  OutputOptions options;
  std::uintmax_t size = 0;
  options.verify = [&](const fs::path& path) {
    size = fs::file_size(path);
    EXPECT_FALSE(fs::exists(folder.path() / "a.txt"));
  };
  write_text(folder.path() / "a.txt", std::string(3 << 20, 'x'), options);
  EXPECT_EQ(size, std::uintmax_t{3 << 20});
  EXPECT_EQ(fs::file_size(folder.path() / "a.txt"), size);
}

class AlwaysCancelled final : public Progress {
 public:
  void advance(std::uint64_t, std::uint64_t) override {}
  bool cancelled() override { return true; }
};

TEST(WriteOutput, LeavesNothingWhenCancelled) {
  const TemporaryFolder folder;
  AlwaysCancelled progress;
  EXPECT_THROW(write_text(folder.path() / "a.txt", "text", {.progress = &progress}), Cancelled);
  EXPECT_TRUE(folder.names().empty());
}

TEST(WriteOutput, WritesThroughALink) {
  const TemporaryFolder folder;
  folder.write("target.txt", "old");
  fs::create_symlink("target.txt", folder.path() / "link.txt");
  write_text(folder.path() / "link.txt", "new", {.existing = Existing::replace});
  EXPECT_TRUE(fs::is_symlink(folder.path() / "link.txt"));
  EXPECT_EQ(folder.read("target.txt"), "new");
}

TEST(WriteOutput, RefusesALinkUnlessToldToReplaceAndOneThatLeadsNowhere) {
  const TemporaryFolder folder;
  folder.write("target.txt", "old");
  fs::create_symlink("target.txt", folder.path() / "link.txt");
  EXPECT_THROW(write_text(folder.path() / "link.txt", "new"), OutputExists);
  fs::create_symlink("nowhere.txt", folder.path() / "broken.txt");
  for (const Existing existing : {Existing::refuse, Existing::replace}) {
    EXPECT_THROW(write_text(folder.path() / "broken.txt", "new", {.existing = existing}), std::runtime_error);
  }
  EXPECT_EQ(folder.names(), (std::set<std::string>{"target.txt", "link.txt", "broken.txt"}));
}

fs::perms mode_of(const fs::path& path) {
  return fs::status(path).permissions();
}

TEST(WriteOutput, KeepsTheModeOfAReplacedFile) {
  const TemporaryFolder folder;
  folder.write("a.txt", "secret");
  for (const auto mode : {fs::perms::owner_read | fs::perms::owner_write,
                          fs::perms::owner_all | fs::perms::group_all | fs::perms::others_write}) {
    fs::permissions(folder.path() / "a.txt", mode);
    write_text(folder.path() / "a.txt", "new", {.existing = Existing::replace});
    EXPECT_EQ(mode_of(folder.path() / "a.txt"), mode);
  }
}

TEST(WriteOutput, GivesANewFileTheUsersMode) {
  const TemporaryFolder folder;
  folder.write("plain.txt", "");
  write_text(folder.path() / "a.txt", "new");
  EXPECT_EQ(mode_of(folder.path() / "a.txt"), mode_of(folder.path() / "plain.txt"));
}

TEST(WriteOutput, DoesNotReplaceWhatAppearsMeanwhile) {
  const TemporaryFolder folder;
  const auto late = [&](std::ostream& stream) {
    stream << "ours";
    folder.write("a.txt", "theirs");
  };
  EXPECT_THROW(write_output(folder.path() / "a.txt", {}, late), OutputExists);
  EXPECT_EQ(folder.read("a.txt"), "theirs");
  EXPECT_EQ(folder.names(), std::set<std::string>{"a.txt"});
}

TEST(OutputGroup, FilesAppearTogether) {
  const TemporaryFolder folder;
  folder.write("b.txt", "old");
  {
    OutputGroup group;
    write_text(folder.path() / "a.txt", "a", {.group = &group});
    write_text(folder.path() / "b.txt", "b", {.existing = Existing::replace, .group = &group});
    EXPECT_EQ(folder.names(), std::set<std::string>{"b.txt"});
    EXPECT_EQ(folder.read("b.txt"), "old");
    group.appear();
  }
  EXPECT_EQ(folder.read("a.txt") + folder.read("b.txt"), "ab");
  EXPECT_EQ(folder.names(), (std::set<std::string>{"a.txt", "b.txt"}));
}

TEST(OutputGroup, NoFileAppearsWithoutTheOthers) {
  const TemporaryFolder folder;
  folder.write("b.txt", "old");
  {
    OutputGroup group;
    write_text(folder.path() / "a.txt", "a", {.group = &group});
    write_text(folder.path() / "b.txt", "b", {.existing = Existing::replace, .group = &group});
    write_text(folder.path() / "c.txt", "c", {.group = &group});
    folder.write("c.txt", "theirs");
    EXPECT_THROW(group.appear(), OutputExists);
  }
  EXPECT_EQ(folder.read("b.txt") + folder.read("c.txt"), "oldtheirs");
  EXPECT_EQ(folder.names(), (std::set<std::string>{"b.txt", "c.txt"}));
}

TEST(OutputTarget, IsOneForAllNamesOfAFile) {
  const TemporaryFolder folder;
  folder.write("a.txt", "");
  fs::create_directory(folder.path() / "in");
  fs::create_symlink("a.txt", folder.path() / "link.txt");
  fs::create_directory_symlink(".", folder.path() / "here");
  for (const char* name : {"link.txt", "./a.txt", "in/../a.txt", "here/a.txt", "here/link.txt"}) {
    EXPECT_EQ(output_target(folder.path() / name), output_target(folder.path() / "a.txt")) << name;
  }
  EXPECT_NE(output_target(folder.path() / "b.txt"), output_target(folder.path() / "a.txt"));
}

TEST(WriteOutput, CanSeek) {
  const TemporaryFolder folder;
  write_output(folder.path() / "a.txt", {}, [](std::ostream& stream) {
    stream << "0123456789";
    stream.seekp(3);
    stream << "abc";
    EXPECT_EQ(stream.tellp(), std::streampos(6));
  });
  EXPECT_EQ(folder.read("a.txt"), "012abc6789");
}

TEST(RequireWritable, NamesThePathAndTheReason) {
  const TemporaryFolder folder;
  folder.write("file", "");
  const auto refused = [&](const std::string& name) {
    return message_of<std::runtime_error>([&] { require_writable(folder.path() / name, Existing::replace); });
  };
  const std::string here = folder.path().string();
  EXPECT_EQ(refused("nowhere/a.txt"), here + "/nowhere/a.txt: there is no folder " + here + "/nowhere");
  EXPECT_EQ(refused("file/a.txt"), here + "/file/a.txt: there is no folder " + here + "/file");
  EXPECT_EQ(refused(""), here + "/: is a folder; a file name is needed");
  EXPECT_EQ(message_of<std::runtime_error>([] { require_writable("/dev/null", Existing::replace); }),
            "/dev/null: is not a regular file");
  EXPECT_THROW(require_writable(folder.path() / "file", Existing::refuse), OutputExists);
  EXPECT_NO_THROW(require_writable("-", Existing::refuse));
}

}  // namespace
}  // namespace solidnoise::output_file_test

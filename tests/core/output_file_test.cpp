#include "solidnoise/core/output_file.h"

#include <filesystem>
#include <ostream>
#include <stdexcept>
#include <string>

#include <gtest/gtest.h>

#include "support/message_of.h"
#include "support/temporary_folder.h"

namespace solidnoise {
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
}  // namespace solidnoise

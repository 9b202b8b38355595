#include "solidnoise/core/printable.h"

#include <string>

#include <gtest/gtest.h>

namespace solidnoise::printable_test {
namespace {

TEST(Printable, KeepsWordsOfAnyScript) {
  for (const std::string text : {"", "plain text", "Größe", "雲", "🌫"}) EXPECT_EQ(printable(text), text);
}

TEST(Printable, EscapesWhatATerminalWouldObey) {
  EXPECT_EQ(printable("\x1b[2Ja\nb\x7f"), "\\x1b[2Ja\\x0ab\\x7f");
  EXPECT_EQ(printable("\xc2\x9b!"), "\\xc2\\x9b!");  // U+009B, a control sequence's begin in one character
}

TEST(Printable, EscapesWhatTurnsTheDirectionOfWriting) {
  EXPECT_EQ(printable("a\u202e\u202ab"), "a\\xe2\\x80\\xae\\xe2\\x80\\xaab");
  EXPECT_EQ(printable("\u2066\u2069"), "\\xe2\\x81\\xa6\\xe2\\x81\\xa9");
  for (const std::string text : {"\u2029", "\u202f", "\u2065", "\u206a"}) EXPECT_EQ(printable(text), text);
}

TEST(Printable, EscapesWhatIsNoUtf8) {
  EXPECT_EQ(printable("a\xff"), "a\\xff");
  EXPECT_EQ(printable("\xe9\x9b"), "\\xe9\\x9b");
  // A surrogate, a character in more bytes than it needs, and one beyond the last.
  EXPECT_EQ(printable("\xed\xa0\x80"), "\\xed\\xa0\\x80");
  EXPECT_EQ(printable("\xe0\x80\x80"), "\\xe0\\x80\\x80");
  EXPECT_EQ(printable("\xf4\x90\x80\x80"), "\\xf4\\x90\\x80\\x80");
  EXPECT_EQ(printable("\xc0\x80"), "\\xc0\\x80");
}

TEST(Printable, CutsLongTextsBetweenCharacters) {
  EXPECT_EQ(printable(std::string(80, 'x')), std::string(80, 'x'));
  EXPECT_EQ(printable(std::string(5000, 'x')), std::string(80, 'x') + "...");
  EXPECT_EQ(printable("aé", 2), "a...");
}

}  // namespace
}  // namespace solidnoise::printable_test

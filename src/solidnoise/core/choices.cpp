#include "solidnoise/core/choices.h"

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

namespace solidnoise {
namespace {

// Number of letters to insert, delete or replace, or of neighbours to swap, to get from one word to the
// other.
std::size_t edit_distance(std::string_view from, std::string_view to) {
  std::vector<std::size_t> before_last;
  std::vector<std::size_t> last(to.size() + 1);
  for (std::size_t j = 0; j <= to.size(); ++j) last[j] = j;
  for (std::size_t i = 1; i <= from.size(); ++i) {
    std::vector<std::size_t> row(to.size() + 1, i);
    for (std::size_t j = 1; j <= to.size(); ++j) {
      const std::size_t replaced = last[j - 1] + (from[i - 1] == to[j - 1] ? 0 : 1);
      row[j] = std::min({row[j - 1] + 1, last[j] + 1, replaced});
      const bool is_swap = i > 1 && j > 1 && from[i - 1] == to[j - 2] && from[i - 2] == to[j - 1];
      if (is_swap) row[j] = std::min(row[j], before_last[j - 2] + 1);
    }
    before_last = std::exchange(last, std::move(row));
  }
  return last[to.size()];
}

}  // namespace

std::string_view nearest_word(std::string_view typed, std::span<const std::string_view> words) {
  constexpr std::size_t kShort = 4;  // letters
  constexpr std::size_t kLongest = 100;
  if (typed.size() > kLongest) return {};
  std::string_view nearest;
  std::size_t least = typed.size() <= kShort ? 2 : 3;
  for (const std::string_view word : words) {
    const std::size_t distance = edit_distance(typed, word);
    // Of two as near the shorter.
    if (distance < least || (distance == least && word.size() < nearest.size())) nearest = word;
    least = std::min(least, distance);
  }
  return nearest;
}

}  // namespace solidnoise

#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace solidnoise {

// Draws numbers 0 to n - 1 with given probabilities in constant time, by the alias method (Walker 1977; made
// in linear time as by Vose 1991): every column has one number below its threshold and another one above.
class AliasTable {
 public:
  // Weights are probabilities up to a factor. Throws std::invalid_argument if one is negative or not finite,
  // if they add up to 0, or if there are more than 2^20.
  explicit AliasTable(std::span<const double> weights);

  std::size_t size() const { return columns_.size(); }

  // The number for a uniform random `unit` in [0, 1): its leading bits are the column, the rest decides. A
  // number's probability is exact to 2^-32 where `unit` has 53 bits.
  std::size_t draw(double unit) const {
    const double scaled = unit * static_cast<double>(columns_.size());
    const auto column = static_cast<std::size_t>(scaled);
    const Column& at = columns_[column];
    return scaled - static_cast<double>(column) < at.threshold ? column : at.alias;
  }

 private:
  struct Column {
    double threshold = 1.0;
    std::uint32_t alias = 0;
  };
  std::vector<Column> columns_;
};

}  // namespace solidnoise

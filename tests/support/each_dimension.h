#pragma once

#include <gtest/gtest.h>

namespace solidnoise {

// Calls check.operator()<Dim>() for 1 to 4 dimensions.
template <typename Check>
void for_each_dimension(const Check& check) {
  const auto run = [&]<int Dim>() {
    SCOPED_TRACE(testing::Message() << Dim << " dimensions");
    check.template operator()<Dim>();
  };
  run.template operator()<1>();
  run.template operator()<2>();
  run.template operator()<3>();
  run.template operator()<4>();
}

}  // namespace solidnoise

#include "compat.h"

#include <boost/math/special_functions/bessel.hpp>
#include <boost/math/special_functions/beta.hpp>
#include <cerrno>
#include <cmath>
#include <cstdlib>
#include <string>

namespace std {
namespace {

// Without long doubles, which WebAssembly has in software only.
using InDouble = boost::math::policies::policy<boost::math::policies::promote_double<false>>;

}  // namespace

double beta(double a, double b) {
  return boost::math::beta(a, b, InDouble());
}

double cyl_bessel_j(double order, double x) {
  return boost::math::cyl_bessel_j(order, x, InDouble());
}

namespace {

// The C library's, whose locale is always "C" here; it would take blanks and a plus before the number, too.
template <typename Number>
from_chars_result read_number(const char* first, const char* last, Number& value,
                              Number (*read)(const char*, char**)) {
  const string text(first, last);
  if (text.empty() || text[0] == '+' || isspace(static_cast<unsigned char>(text[0]))) {
    return {first, errc::invalid_argument};
  }
  char* end = nullptr;
  const Number found = read(text.c_str(), &end);
  if (end == text.c_str()) return {first, errc::invalid_argument};
  const char* const after = first + (end - text.c_str());
  if (!isfinite(found) && (text.find_first_of("0123456789") < static_cast<size_t>(end - text.c_str()))) {
    return {after, errc::result_out_of_range};
  }
  value = found;
  return {after, errc()};
}

}  // namespace

from_chars_result from_chars(const char* first, const char* last, double& value) {
  return read_number<double>(first, last, value, strtod);
}

from_chars_result from_chars(const char* first, const char* last, float& value) {
  return read_number<float>(first, last, value, strtof);
}

}  // namespace std

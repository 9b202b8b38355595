#pragma once

#include <pybind11/pybind11.h>
#include <string>
#include <string_view>

#include "solidnoise/recipe/json.h"

namespace solidnoise::python {

// The options of a schema, as the manual of a function with keywords has them: name, type, range and default,
// then what it is.
std::string describe_options(const Json& schema);

// Its keywords with defaults, as a signature has them: ", frequency=8.0, bandwidth=1.0".
std::string signature_of_options(const Json& schema);

// The documentation of a function: its signature, which inspect.signature() reads, and the text.
std::string document(std::string_view signature, std::string_view text);

// schema(), the tables themselves, for those who make controls of them.
void add_schema(pybind11::module_& module);

}  // namespace solidnoise::python

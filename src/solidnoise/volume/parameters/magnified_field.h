#pragma once

#include <memory>

#include "solidnoise/volume/field/field.h"
#include "solidnoise/volume/field/point_field.h"
#include "solidnoise/volume/parameters/parameter_fields.h"

namespace solidnoise {

// A field times that of the magnitude at each position. Precondition: there is one. Evaluation throws what
// ScalarField does.
std::shared_ptr<const Field> with_magnitude(std::shared_ptr<const Field> source,
                                            std::shared_ptr<const ParameterFields> fields);
std::shared_ptr<const PointField> with_magnitude(std::shared_ptr<const PointField> source,
                                                 std::shared_ptr<const ParameterFields> fields);

}  // namespace solidnoise

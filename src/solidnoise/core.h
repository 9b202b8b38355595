// All of the component core: positions, lattices, fields, progress, checks of options.
#pragma once

#include "solidnoise/core/check.h"
#include "solidnoise/core/digest.h"
#include "solidnoise/core/field.h"
#include "solidnoise/core/fields.h"
#include "solidnoise/core/image.h"
#include "solidnoise/core/moments.h"
#include "solidnoise/core/points.h"
#include "solidnoise/core/progress.h"
#include "solidnoise/core/random.h"
#include "solidnoise/core/vec.h"

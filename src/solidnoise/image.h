// All of the component image: pictures, their files and colour ramps.
#pragma once

#include "solidnoise/image/color.h"
#include "solidnoise/image/drawing.h"
#include "solidnoise/image/image_file.h"

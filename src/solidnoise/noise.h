// All of the component noise: make_noise() from a recipe, the noises themselves, octaves, slices and
// movements of them, and their interpolation within an error.
#pragma once

#include "solidnoise/noise/cellular/cellular_noise.h"
#include "solidnoise/noise/error_budget.h"
#include "solidnoise/noise/fractal_noise.h"
#include "solidnoise/noise/gabor/gabor_noise.h"
#include "solidnoise/noise/gabor/oriented_gabor_noise.h"
#include "solidnoise/noise/gabor/spectrum_noise.h"
#include "solidnoise/noise/gradient/gradient_noise.h"
#include "solidnoise/noise/interpolation/interpolated_noise.h"
#include "solidnoise/noise/noise.h"
#include "solidnoise/noise/noise_views.h"
#include "solidnoise/noise/registry/noise_entries.h"
#include "solidnoise/noise/registry/noise_recipe.h"

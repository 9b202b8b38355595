// All of the component analysis: measured spectra against closed forms, plots, and noise by example.
#pragma once

#include "solidnoise/analysis/dense_field.h"
#include "solidnoise/analysis/exemplar/describe_fit.h"
#include "solidnoise/analysis/exemplar/edit_spectrum.h"
#include "solidnoise/analysis/exemplar/exemplar.h"
#include "solidnoise/analysis/exemplar/exemplar_sheet.h"
#include "solidnoise/analysis/exemplar/fit_exemplar.h"
#include "solidnoise/analysis/exemplar/solid_spectrum.h"
#include "solidnoise/analysis/expected_spectrum.h"
#include "solidnoise/analysis/fft.h"
#include "solidnoise/analysis/field_picture.h"
#include "solidnoise/analysis/four_panel.h"
#include "solidnoise/analysis/kernel_slice.h"
#include "solidnoise/analysis/line_plot.h"
#include "solidnoise/analysis/periodogram.h"
#include "solidnoise/analysis/radial_spectrum.h"

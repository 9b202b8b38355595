// All of the component field: what is made of noises and of other fields.
#pragma once

#include "solidnoise/field/cloud_field.h"
#include "solidnoise/field/combined_field.h"
#include "solidnoise/field/curl_field.h"
#include "solidnoise/field/derived_fields.h"
#include "solidnoise/field/field_tables.h"
#include "solidnoise/field/layered_field.h"
#include "solidnoise/field/moved_field.h"
#include "solidnoise/field/pointwise_field.h"
#include "solidnoise/field/shaping.h"
#include "solidnoise/field/shared_field.h"
#include "solidnoise/field/value_maps.h"
#include "solidnoise/field/varying_field.h"

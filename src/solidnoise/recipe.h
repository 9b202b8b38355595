// All of the component recipe: JSON and its schema from tables of fields.
#pragma once

#include "solidnoise/recipe/exemplar_file.h"
#include "solidnoise/recipe/exemplar_model_json.h"
#include "solidnoise/recipe/field_json.h"
#include "solidnoise/recipe/json.h"
#include "solidnoise/recipe/json_reader.h"
#include "solidnoise/recipe/json_schema.h"
#include "solidnoise/recipe/noise_recipe_json.h"
#include "solidnoise/recipe/recipe_file.h"

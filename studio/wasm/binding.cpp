// The C interface of the page: a question in JSON, with the bytes of a file where one goes with it, an answer
// in JSON, with arrays.

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <emscripten/emscripten.h>
#include <exception>
#include <new>
#include <span>
#include <stdexcept>
#include <string>

#include <nlohmann/json.hpp>

#include "commands.h"

namespace solidnoise::studio {
namespace {

constexpr NamedCommand kCommands[] = {
    {"fields", describe_fields},    {"check", check_recipe},     {"edit", edit_recipe},
    {"slice", make_slice},          {"spectrum", make_spectrum}, {"volume", make_volume_values},
    {"light", light_volume},        {"mesh", load_mesh},         {"bake", bake_mesh},
    {"fit", fit_example},           {"version", draw_version},   {"texture", draw_example},
    {"edit example", edit_example},
};

// Answers live until the next question.
Answer answer;
std::string text;

void run(const Json& question, std::span<const unsigned char> bytes) {
  const std::string name = question.at("do");
  for (const NamedCommand& command : kCommands) {
    if (command.name != name) continue;
    answer = command.run(question, bytes);
    return;
  }
  throw std::invalid_argument("nothing is known of \"" + name + "\"");
}

}  // namespace
}  // namespace solidnoise::studio

using namespace solidnoise;
using namespace solidnoise::studio;

extern "C" {

EMSCRIPTEN_KEEPALIVE void* reserve(std::size_t bytes) {
  return std::malloc(bytes);
}
EMSCRIPTEN_KEEPALIVE void release(void* memory) {
  std::free(memory);
}

// Answers a question, a text that ends with a 0; the answer is one, too. Errors are {"error": "what is
// wrong"}, or {"memory": true} where it ended.
EMSCRIPTEN_KEEPALIVE const char* ask(const char* question, const unsigned char* bytes, std::size_t count) {
  answer = {};
  try {
    run(Json::parse(question), {bytes, count});
  } catch (const std::bad_alloc&) {
    answer = {Json{{"memory", true}}};
  } catch (const std::length_error&) {  // more than a vector can have here
    answer = {Json{{"memory", true}}};
  } catch (const std::exception& error) {
    answer = {Json{{"error", error.what()}}};
  }
  answer.json["arrays"] = answer.floats.size();
  // Errors quote what they are of, which may have any bytes.
  text = answer.json.dump(-1, ' ', false, Json::error_handler_t::replace);
  return text.c_str();
}

EMSCRIPTEN_KEEPALIVE const float* array_values(std::size_t index) {
  return answer.floats[index].data();
}
EMSCRIPTEN_KEEPALIVE std::size_t array_size(std::size_t index) {
  return answer.floats[index].size();
}
}

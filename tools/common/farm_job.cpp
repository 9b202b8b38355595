#include "common/farm_job.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <stdexcept>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "solidnoise/recipe/recipe_file.h"

namespace solidnoise {

double FarmStep::memory_of_job() const {
  constexpr double kMebibyte = 0x1p20;
  return std::ceil(1.25 * bytes / kMebibyte) + 64.0;
}

void chunk_tasks(const FarmOptions& options, std::vector<FarmStep>& steps) {
  for (FarmStep& step : steps) {
    const double that_last = step.seconds > 0.0 ? std::ceil(options.job_time / step.seconds) : step.tasks;
    const double that_fit = std::ceil(static_cast<double>(step.tasks) / options.most_jobs);
    step.tasks_per_job = static_cast<int>(std::clamp(std::max(that_last, that_fit), 1.0, 1.0 * step.tasks));
  }
}

std::string FarmJob::name() const {
  std::string name = folder.stem().string();
  std::replace_if(
      name.begin(), name.end(),
      [](unsigned char c) { return std::isalnum(c) == 0 && c != '_' && c != '-' && c != '.'; }, '_');
  constexpr std::size_t kLongest = 100;
  return name.substr(0, kLongest);
}

std::string format_farm_job(const FarmJob& job) {
  Json json;
  json["program"] = job.program.string();
  json["directory"] = job.directory.string();
  json["arguments"] = job.arguments;
  json["threads"] = job.threads;
  if (job.at_once) json["at_once"] = *job.at_once;
  for (const FarmStep& step : job.steps) {
    json["steps"].push_back({{"name", step.name},
                             {"tasks", step.tasks},
                             {"tasks_per_job", step.tasks_per_job},
                             {"seconds", step.seconds},
                             {"bytes", step.bytes}});
  }
  return format_json(json);
}

FarmJob read_farm_job(const std::filesystem::path& folder) {
  const std::filesystem::path file = folder / "job.json";
  const std::string text = read_text_file(file);
  try {
    const Json json = parse_json(text);
    FarmJob job;
    job.folder = std::filesystem::canonical(folder);
    job.program = json.at("program").get<std::string>();
    job.directory = json.at("directory").get<std::string>();
    job.arguments = json.at("arguments").get<std::vector<std::string>>();
    job.threads = json.at("threads").get<int>();
    if (json.contains("at_once")) job.at_once = json["at_once"].get<int>();
    for (const Json& step : json.at("steps")) {
      job.steps.push_back({step.at("name").get<std::string>(), step.at("tasks").get<int>(),
                           step.at("seconds").get<double>(), step.at("bytes").get<double>(),
                           std::max(1, step.at("tasks_per_job").get<int>())});
    }
    return job;
  } catch (const Json::exception&) {
    throw std::runtime_error(fmt::format("{}: is no job for a farm: it lacks what a job has", file.string()));
  } catch (const std::exception& error) {
    throw std::runtime_error(fmt::format("{}: is no job for a farm: {}", file.string(), error.what()));
  }
}

}  // namespace solidnoise

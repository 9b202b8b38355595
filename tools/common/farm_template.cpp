#include <string>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "common/farm_scripts.h"

namespace solidnoise {
namespace {

Json path_parameter(const char* name, const char* object, const char* flow, const std::string& path,
                    const char* description) {
  return {{"name", name},     {"type", "PATH"},  {"objectType", object},
          {"dataFlow", flow}, {"default", path}, {"description", description}};
}

Json amount(const char* name, double least) {
  return {{"name", name}, {"min", least}};
}

Json step_of(const FarmJob& job, std::size_t index) {
  const FarmStep& step = job.steps[index];
  Json json = {{"name", step.name}};
  if (index > 0) json["dependencies"] = Json::array({{{"dependsOn", job.steps[index - 1].name}}});
  json["hostRequirements"]["amounts"] = Json::array(
      {amount("amount.worker.vcpu", job.threads), amount("amount.worker.memory", step.memory_of_job())});
  json["parameterSpace"]["taskParameterDefinitions"] =
      Json::array({{{"name", "Job"}, {"type", "INT"}, {"range", fmt::format("1-{}", step.jobs())}}});
  Json& run = json["script"]["actions"]["onRun"];
  run["command"] = "{{Param.Program}}";
  run["args"] = {"farm", "run", "{{Param.Folder}}", step.name, "{{Task.Param.Job}}"};
  run["cancelation"] = {{"mode", "NOTIFY_THEN_TERMINATE"}, {"notifyPeriodInSeconds", 30}};
  return json;
}

}  // namespace

std::string open_job_template(const FarmJob& job) {
  Json json;
  json["specificationVersion"] = "jobtemplate-2023-09";
  json["name"] = job.name();
  json["parameterDefinitions"] = Json::array(
      {path_parameter("Folder", "DIRECTORY", "INOUT", job.folder.string(), "The job's folder"),
       path_parameter("Program", "FILE", "NONE", job.program.string(), "The program that runs its tasks")});
  for (std::size_t i = 0; i < job.steps.size(); ++i) json["steps"].push_back(step_of(job, i));
  return format_json(json);
}

}  // namespace solidnoise

// SPDX-License-Identifier: MIT
#include "dataset/tiny_plan.h"

#include <stdexcept>

#include "base/staged_outputs.h"
#include "project/fields.h"
#include "project/json.h"

namespace sigs::test {

namespace fs = std::filesystem;

TinyPlan::TinyPlan(int videos, int frames) : tiny_(frames) {
  Project project = read_project(tiny_.project()).value().project;
  for (const Field& field : fields_of(project))
    if (field.is_path)
      if (std::string& path = *std::get<std::string*>(field.value); !path.empty())
        path = resolved(project, path).string();
  project.footage.last_frame = frames - 1;
  plan.name = "tiny";
  for (int i = 0; i < videos; ++i) {
    project.name = "v" + std::to_string(i);
    project.intruders[0].trajectory.waypoints[0].position_m.y = -3 + i;
    plan.videos.push_back({.name = project.name,
                           .project = project,
                           .split = i % 3 == 2 ? "test" : "train",
                           .tags = {{"background", "clip"}, {"aircraft", "cube"}, {"flight", "left_right"}},
                           .sampled = {{"distance_m", 20.0 + i}}});
  }
}

DatasetSource synthetic_source(const std::string& program) {
  return {.program = program, .seed = 0, .recipe = R"({"name": "tiny"})"};
}

DatasetReport made(const Plan& plan, const DatasetRequest& request) {
  Result<DatasetReport> report = make_dataset(plan, request, {});
  if (!report) throw std::runtime_error(report.error().text());
  return std::move(*report);
}

}  // namespace sigs::test

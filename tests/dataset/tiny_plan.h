// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <string>

#include "cli/tiny_project.h"
#include "dataset/plan.h"
#include "dataset/run.h"

namespace sigs::test {

// A plan of some videos of the tiny project, each with a flight of its own, in two splits.
class TinyPlan {
 public:
  explicit TinyPlan(int videos = 4, int frames = 6);

  [[nodiscard]] const TinyProject& inputs() const { return tiny_; }
  [[nodiscard]] std::filesystem::path out(const std::string& name = "out") const { return tiny_.file(name); }

  Plan plan;

 private:
  TinyProject tiny_;
};

[[nodiscard]] DatasetSource synthetic_source(const std::string& program = "test 1");

// Runs it; throws an error as std::runtime_error.
[[nodiscard]] DatasetReport made(const Plan& plan, const DatasetRequest& request);

}  // namespace sigs::test

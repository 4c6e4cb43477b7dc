// SPDX-License-Identifier: MIT
#include "dataset/recipe_folder.h"

#include <stdexcept>

namespace sigs::test {

nlohmann::ordered_json RecipeFolder::recipe() {
  const std::string assets = (source_dir() / "assets").string();
  return {
      {"sigs_dataset", 1},
      {"name", "set"},
      {"backgrounds",
       {{{"name", "day"},
         {"footage", {{"video", assets + "/footage/sample.mp4"}, {"calibration", assets + "/calibrations/sample.xml"}}},
         {"camera", {{"speed_mps", 22}}}}}},
      {"aircraft", {{{"name", "jet"}, {"model", {{"file", assets + "/models/airliner/airliner.obj"}}}}}},
      {"videos", {{{"flights", {"left_right"}}}}}};
}

Result<ReadRecipe> RecipeFolder::read(const nlohmann::ordered_json& json) const {
  return parse_recipe(json.dump(2), file());
}

Plan RecipeFolder::plan(const nlohmann::ordered_json& json) const {
  const Result<ReadRecipe> read_one = read(json);
  if (!read_one) throw std::runtime_error(read_one.error().text());
  Result<Plan> plan = plan_of(read_one->recipe);
  if (!plan) throw std::runtime_error(plan.error().text());
  return *std::move(plan);
}

std::string RecipeFolder::error(const nlohmann::ordered_json& json) const {
  const Result<ReadRecipe> read_one = read(json);
  const Result<Plan> plan = read_one ? plan_of(read_one->recipe) : Result<Plan>(tl::unexpect, read_one.error());
  if (plan) return {};
  const std::string text = plan.error().text();
  const std::string begin = file().string() + ": ";
  return text.starts_with(begin) ? text.substr(begin.size()) : "elsewhere: " + text;
}

}  // namespace sigs::test

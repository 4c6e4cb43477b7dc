// SPDX-License-Identifier: MIT
#include "first_project/first_model.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <utility>

#include "base/paths.h"
#include "base/resources.h"
#include "base/text.h"
#include "mesh/geometry.h"
#include "mesh/model_files.h"

namespace sigs {

namespace fs = std::filesystem;

namespace {

constexpr const char* kSample = "assets/models/light-aircraft/light-aircraft.obj";
constexpr const char* kSampleModels = "assets/models";
constexpr double kMinMetres = 1;  // lengths that are taken to be in metres
constexpr double kMaxMetres = 90;
constexpr double kUsual_m = 10;  // length of a light aircraft

struct LengthUnit {
  const char* name;
  double scale;  // metres
};
constexpr std::array<LengthUnit, 4> kUnits{
    {{"millimetres", 1e-3}, {"centimetres", 1e-2}, {"inches", 0.0254}, {"feet", 0.3048}}};

// How far a length is from that of a light aircraft, as a ratio.
double oddness(double length_m) {
  return std::abs(std::log(length_m / kUsual_m));
}

FirstProjectNote axes_note(const ModelShape& shape, const ModelSettings& settings) {
  FirstProjectNote note{.field = "intruders[0].model.forward", .is_guess = true};
  const bool is_sure = shape.nose_is_sure && shape.top_is_sure;
  note.text = fmt::format("nose {}, up {}, {}; if the aircraft flies tail first or upside down, turn the signs",
                          settings.forward, settings.up,
                          is_sure ? "judged by the model's shape" : "a guess, which the shape does not confirm");
  return note;
}

}  // namespace

std::string category_of_model(const fs::path& file) {
  const std::string name = lower_case(file.filename().string());
  const auto has = [&](const char* word) { return name.find(word) != std::string::npos; };
  if (has("heli")) return "helicopter";
  if (has("drone") || has("quad") || has("uav") || has("copter") || has("multirotor")) return "drone";
  if (has("glider") || has("sailplane")) return "glider";
  if (has("balloon")) return "balloon";
  if (has("bird")) return "bird";
  if (has("insect")) return "insect";
  return "airplane";
}

FirstProjectNote unit_note(double length, ModelSettings& settings) {
  FirstProjectNote note{.field = "intruders[0].model.scale"};
  if (length >= kMinMetres && length <= kMaxMetres) {
    note.text = fmt::format("1, the file is {:.3g} long: metres are assumed", length);
    note.is_guess = true;
    return note;
  }
  note.is_guess = true;
  const LengthUnit unit = *std::min_element(
      kUnits.begin(), kUnits.end(),
      [&](const LengthUnit& a, const LengthUnit& b) { return oddness(length * a.scale) < oddness(length * b.scale); });
  if (length > kMaxMetres && length * unit.scale >= kMinMetres && length * unit.scale <= kMaxMetres) {
    settings.scale = unit.scale;
    note.text = fmt::format("{}, the file is {:.4g} long, which are taken as {}: {:.3g} m", number_text(unit.scale, 4),
                            length, unit.name, length * unit.scale);
    return note;
  }
  settings.length_m = kUsual_m;
  note.field = "intruders[0].model.length_m";
  note.text = fmt::format("{} m, the file is {:.3g} long in no unit of aircraft; set it to what the aircraft measures",
                          number_text(kUsual_m, 1), length);
  return note;
}

Result<FirstModel> users_model(const fs::path& file, SceneFiles& files) {
  const Result<Mesh> plain = read_obj(file);
  if (!plain) return fail(plain.error());
  const ModelShape shape = shape_of(*plain);
  FirstModel first{.file = file, .category = category_of_model(file)};
  // Where the shape does not tell a sign, the file's positive axis is taken.
  const auto positive_unless = [](std::string axis, bool is_sure) { return is_sure ? axis : "+" + axis.substr(1); };
  first.settings.forward = positive_unless(file_axis(shape.nose, {}), shape.nose_is_sure);
  first.settings.up = positive_unless(file_axis(shape.top, {}), shape.top_is_sure);
  const glm::dvec3 size = glm::dvec3(plain->high_m - plain->low_m);
  first.notes.push_back(axes_note(shape, first.settings));
  first.notes.push_back(unit_note(std::abs(glm::dot(size, glm::abs(shape.nose))), first.settings));
  first.notes.push_back(
      {.field = "intruders[0].category", .text = first.category + ", by the file's name", .is_guess = true});
  first.settings.anchor = AnchorChoice::bounds;
  Result<std::shared_ptr<const Model>> model = files.model(file, {.forward = first.settings.forward,
                                                                  .up = first.settings.up,
                                                                  .scale = first.settings.scale,
                                                                  .length_m = first.settings.length_m,
                                                                  .anchor_at_bounds = true});
  if (!model) return fail(model.error());
  first.model = *std::move(model);
  first.warnings = first.model->mesh.warnings;
  return first;
}

bool is_sample_model(const fs::path& file) {
  const Result<fs::path> samples = resource_file(kSampleModels);
  return samples && is_at_or_below(canonical_path(file), canonical_path(*samples));
}

Result<FirstModel> sample_model(const fs::path& chosen, SceneFiles& files) {
  const Result<fs::path> file = chosen.empty() ? resource_file(kSample) : Result<fs::path>(chosen);
  if (!file) return fail(file.error());
  Result<std::shared_ptr<const Model>> model = files.model(*file, ModelAxes{});
  if (!model) return fail(model.error());
  FirstModel first{.file = *file, .model = *std::move(model), .category = category_of_model(*file)};
  const std::string name = chosen.empty() ? "light aircraft" : file->stem().string();
  first.notes.push_back({.field = "intruders[0].model.file",
                         .text = fmt::format("the sample {}, copied beside the project", name),
                         .is_guess = chosen.empty(),
                         .remedy = chosen.empty() ? "--model takes another one" : ""});
  return first;
}

Result<CopiedModel> copied_model(const fs::path& file, const fs::path& folder) {
  constexpr int kMaxUp = 1;
  const Result<std::vector<fs::path>> sources = files_of_model(file);
  if (!sources) return fail(sources.error());
  const fs::path obj = canonical_name(file);
  fs::path above = obj.parent_path();  // the folder that holds them all
  for (const fs::path& source : *sources)
    for (int up = 0; !is_at_or_below(canonical_name(source), above); ++up, above = above.parent_path())
      if (up == kMaxUp || above == above.parent_path())
        return fail(file.string(),
                    fmt::format("cannot be copied: its file {} lies outside of its folder", source.string()));
  CopiedModel copied{.obj = folder / obj.lexically_relative(above)};
  std::set<fs::path> names;  // an image that several materials name is listed for each of them
  for (const fs::path& source : *sources) {
    const fs::path name = canonical_name(source).lexically_relative(above);
    if (names.insert(name).second) copied.files.push_back({.path = folder / name, .content = {}, .copy_of = source});
  }
  return copied;
}

Result<fs::path> model_copied_into(const fs::path& folder, const fs::path& model) {
  if (is_at_or_below(canonical_path(model), canonical_path(folder))) return model;
  constexpr int kMaxSameNames = 999;
  Error error;
  for (int i = 1; i <= kMaxSameNames; ++i) {
    const std::string name = model.stem().string() + (i > 1 ? fmt::format("-{}", i) : "");
    const Result<CopiedModel> copied = copied_model(model, folder / name);
    if (!copied) return fail(copied.error());
    const Result<void> written = write_files(copied->files, false);
    if (written) return copied->obj;
    error = written.error();
    std::error_code code;
    if (!fs::exists(folder / name, code)) break;  // another name would not help
  }
  return fail(error);
}

}  // namespace sigs

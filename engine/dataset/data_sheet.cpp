// SPDX-License-Identifier: MIT
#include "dataset/data_sheet.h"

#include <algorithm>
#include <cmath>
#include <pugixml.hpp>
#include <set>
#include <string_view>

#include "base/staged_outputs.h"
#include "base/text.h"
#include "base/threads.h"
#include "camera/camera.h"
#include "dataset/entry.h"
#include "dataset/index.h"
#include "dataset/video_folder.h"
#include "project/json.h"
#include "project/project.h"

namespace sigs {

namespace {

namespace fs = std::filesystem;

// Of a split, a category or the whole.
struct SheetCount {
  int videos = 0;
  long long frames = 0;
  long long intruders = 0;        // one in each video that has it
  long long distractors = 0;      // likewise
  long long intruder_frames = 0;  // frames with a visible box, of intruders
};

// What the annotations say of a background's footage.
struct SheetFootage {
  std::string width, height, frame_rate;
  std::set<std::string> attitude_sources, position_sources;
  long long frames = 0, frames_without_horizon = 0;
};

// Attitude of the camera, where annotations state its standard deviation.
struct SheetAttitude {
  long long frames = 0, stated = 0, unknown = 0;  // unknown: 180 degrees
  double lowest_deg = HUGE_VAL, highest_deg = 0;  // of the largest of three axes, where known

  void add(pugi::xml_node camera) {
    ++frames;
    double largest = -1;
    for (const char* const axis : {"sd_x_deg", "sd_y_deg", "sd_z_deg"})
      if (const double sd = attribute_of(camera, axis); std::isfinite(sd)) largest = std::max(largest, sd);
    if (largest < 0) return;
    ++stated;
    constexpr double kUnknown_deg = 180;  // docs/annotation-format.md
    if (largest >= kUnknown_deg) {
      ++unknown;
      return;
    }
    lowest_deg = std::min(lowest_deg, largest);
    highest_deg = std::max(highest_deg, largest);
  }
};

// All that is collected over the videos.
struct SheetFacts {
  SheetCount all;
  std::map<std::string, SheetCount> splits, categories;
  std::map<std::string, SheetFootage> footage;  // by background
  std::map<std::string, Project> project_of;    // the first of each background
  std::map<std::string, std::string> model_of;  // file, by the intruder's name
  std::set<std::string> formats;                // of labels
  std::set<double> cloud_distances_m;           // that labels state as assumed
  SheetAttitude attitude;
};

// The value of a key, null where there is none.
Json member(const Json& object, const char* key) {
  return object.is_object() && object.contains(key) ? object.at(key) : Json(nullptr);
}

std::string text_in(const Json& object, const char* key, const std::string& standard) {
  const Json value = member(object, key);
  return value.is_string() ? value.get<std::string>() : standard;
}

Json text_or_null(const std::string& text) {
  return text.empty() ? Json(nullptr) : Json(text);
}

void add_frame(pugi::xml_node frame, const std::map<std::string, std::string>& kinds, SheetFacts& facts,
               SheetFootage& footage, SheetCount& split) {
  const pugi::xml_node camera = frame.child("camera");
  facts.attitude.add(camera);
  ++footage.frames;
  for (const auto& [name, sources] :
       {std::pair{"attitude_source", &footage.attitude_sources}, {"position_source", &footage.position_sources}})
    if (const std::string source = camera.attribute(name).value(); !source.empty()) sources->insert(source);
  bool has_horizon = true;
  for (const pugi::xml_node intruder : frame.children("intruder")) {
    has_horizon = has_horizon && std::string_view(intruder.attribute("horizon").value()) != "unknown";
    if (const double at_m = attribute_of(intruder.child("clouds"), "assumed_distance_m"); std::isfinite(at_m))
      facts.cloud_distances_m.insert(at_m);
    if (!intruder.child("box") || std::string_view(intruder.attribute("role").value()) == "distractor") continue;
    const auto kind = kinds.find(intruder.attribute("id").value());
    for (SheetCount* const count : {&facts.all, &split, &facts.categories[kind == kinds.end() ? "?" : kind->second]})
      ++count->intruder_frames;
  }
  if (!has_horizon) ++footage.frames_without_horizon;
}

void add_project(const IndexedVideo& video, const Project& project, SheetFacts& facts, SheetCount& split) {
  const auto background = video.tags.find("background");
  if (background != video.tags.end()) facts.project_of.try_emplace(background->second, project);
  facts.formats.insert(project.output.labels.begin(), project.output.labels.end());
  std::set<std::string> kinds;
  for (const IntruderSettings& intruder : project.intruders) {
    facts.model_of.try_emplace(intruder.name, resolved(project, intruder.model.file).string());
    SheetCount& category = facts.categories[intruder.category];
    kinds.insert(intruder.category);
    for (SheetCount* const count : {&facts.all, &split, &category})
      ++(intruder.role == RoleChoice::distractor ? count->distractors : count->intruders);
  }
  for (const std::string& kind : kinds) ++facts.categories[kind].videos;
}

void add_video(const fs::path& dataset, const IndexedVideo& video, pugi::xml_node root, SheetFacts& facts) {
  SheetCount& split = facts.splits[video.split.empty() ? "all" : video.split];
  if (const Result<ReadProject> project = read_project(dataset / video.name / (video.name + ".json")); project)
    add_project(video, project_of_video(project->project, video.tags), facts, split);
  const auto background = video.tags.find("background");
  SheetFootage& footage = facts.footage[background == video.tags.end() ? "" : background->second];
  const pugi::xml_node shape = root.child("footage");
  footage.width = shape.attribute("width").value();
  footage.height = shape.attribute("height").value();
  footage.frame_rate = shape.attribute("frame_rate").value();
  for (SheetCount* const count : {&facts.all, &split}) ++count->videos;
  for (const pugi::xml_node frame : root.children("frame")) {
    for (SheetCount* const count : {&facts.all, &split}) ++count->frames;
    add_frame(frame, video.categories, facts, footage, split);
  }
}

Json count_json(const SheetCount& count) {
  return {{"videos", count.videos},
          {"frames", count.frames},
          {"intruders", count.intruders},
          {"distractors", count.distractors},
          {"intruder_frames", count.intruder_frames}};
}

Json counts_json(const SheetFacts& facts) {
  Json json{{"all", count_json(facts.all)}, {"splits", Json::object()}, {"categories", Json::object()}};
  for (const auto& [name, count] : facts.splits) json["splits"][name] = count_json(count);
  for (const auto& [name, count] : facts.categories) {
    json["categories"][name] = count_json(count);
    json["categories"][name].erase("frames");
  }
  return json;
}

// Checksums of inputs; null where a file is not there.
class SheetChecksums {
 public:
  explicit SheetChecksums(const std::atomic<bool>* cancel) : inputs_(cancel) {}

  [[nodiscard]] Json of(const fs::path& file) {
    if (file.empty()) return nullptr;
    const Result<std::string> one = fs::is_regular_file(file, code_) ? inputs_.of(file) : inputs_.of_images(file);
    return one ? Json(*one) : Json(nullptr);
  }
  [[nodiscard]] Json of_model(const fs::path& file) {
    const Result<std::string> one = inputs_.of_model(file);
    return one ? Json(*one) : Json(nullptr);
  }

 private:
  InputChecksums inputs_;
  std::error_code code_;
};

Json calibration_json(const fs::path& name, SheetChecksums& checksums) {
  const fs::path file = calibration_name(name).file;
  const Result<std::string> text = read_text(file);
  const std::optional<double> error_px = text ? stated_reprojection_error_px(*text) : std::nullopt;
  return {{"file", name.filename().string()},
          {"sha256", checksums.of(file)},
          {"reprojection_error_px", error_px ? Json(*error_px) : Json(nullptr)}};
}

// Where the camera's attitude comes from.
Json attitude_source(const CameraSettings& camera) {
  if (!camera.track.file.empty()) return "log " + fs::path(camera.track.file).filename().string();
  if (!camera.attitude_file.empty()) return "file " + fs::path(camera.attitude_file).filename().string();
  if (camera.roll_deg || camera.pitch_deg) return "stated in the recipe or its project";
  return nullptr;
}

Json footage_json(const std::string& name, const Json& background, const SheetFacts& facts,
                  const GuessesByBackground& guesses, const Json& measured, SheetChecksums& checksums) {
  Json json{{"background", name}, {"licence", member(background, "licence")}, {"source", member(background, "source")}};
  if (const auto seen = facts.footage.find(name); seen != facts.footage.end()) {
    const SheetFootage& footage = seen->second;
    json["width"] = parsed_number<int>(footage.width).value_or(0);
    json["height"] = parsed_number<int>(footage.height).value_or(0);
    json["frame_rate"] = text_or_null(footage.frame_rate);
    json["frames"] = footage.frames;
    json["frames_without_horizon"] = footage.frames_without_horizon;
    json["position_sources"] = footage.position_sources;
    json["attitude_sources"] = footage.attitude_sources;
  }
  if (const auto there = facts.project_of.find(name); there != facts.project_of.end()) {
    const Project& project = there->second;
    const fs::path video = resolved(project, project.footage.video);
    json["video"] = video.filename().string();
    json["sha256"] = checksums.of(video);
    json["calibration"] = calibration_json(resolved(project, project.footage.calibration), checksums);
    json["camera_attitude"] = attitude_source(project.camera);
    json["assumed_cloud_distance_m"] =
        project.footage.cloud_distance_m ? Json(*project.footage.cloud_distance_m) : Json(nullptr);
  }
  json["made_by_init"] = background.is_object() && background.contains("project");
  const auto guessed = guesses.find(name);
  json["guessed"] = guessed == guesses.end() ? Json(nullptr) : Json(guessed->second);
  if (const Json look = member(measured, name.c_str()); !look.is_null()) json["measured"] = look;
  return json;
}

Json aircraft_json(const Json& aircraft, const SheetFacts& facts, SheetChecksums& checksums) {
  const std::string name = text_in(aircraft, "name", "");
  Json json{{"name", name},
            {"category", text_in(aircraft, "category", IntruderSettings{}.category)},
            {"distractor", member(aircraft, "distractor") == true},
            {"licence", member(aircraft, "licence")},
            {"source", member(aircraft, "source")}};
  const auto model = facts.model_of.find(name);
  json["model"] = model == facts.model_of.end() ? Json(nullptr) : Json(fs::path(model->second).filename().string());
  json["sha256"] = model == facts.model_of.end() ? Json(nullptr) : checksums.of_model(model->second);
  return json;
}

Json labels_json(const SheetFacts& facts) {
  const SheetAttitude& attitude = facts.attitude;
  const bool has_sd = attitude.stated > attitude.unknown;
  Json sd{{"frames", attitude.frames},
          {"frames_stated", attitude.stated},
          {"frames_unknown", attitude.unknown},
          {"lowest_deg", has_sd ? Json(attitude.lowest_deg) : Json(nullptr)},
          {"highest_deg", has_sd ? Json(attitude.highest_deg) : Json(nullptr)}};
  return {{"formats", facts.formats}, {"attitude_sd", std::move(sd)}, {"cloud_distances_m", facts.cloud_distances_m}};
}

// Objects of a list of the recipe that have a name.
std::vector<Json> named_in(const Json& recipe, const char* key) {
  std::vector<Json> named;
  if (const Json list = member(recipe, key); list.is_array())
    std::ranges::copy_if(list, std::back_inserter(named), [](const Json& one) {
      return one.is_object() && one.contains("name") && one.at("name").is_string();
    });
  return named;
}

}  // namespace

std::optional<double> stated_reprojection_error_px(const std::string& calibration) {
  for (const std::string_view key :
       {"avg_reprojection_error", "reprojection_error", "rms_error", "RMS_error", "\"rms\"", "<rms>", "\nrms:"}) {
    const std::size_t at = calibration.find(key);
    if (at == std::string::npos) continue;
    const std::size_t begin = calibration.find_first_not_of(">\":= \t", at + key.size());
    if (begin == std::string::npos) continue;
    const std::size_t end = std::min(calibration.find_first_of("<,} \t\r\n", begin), calibration.size());
    if (const auto number = finite_number(std::string_view(calibration).substr(begin, end - begin))) return number;
  }
  return std::nullopt;
}

Result<Json> data_sheet_of(const fs::path& dataset, const GuessesByBackground& guesses,
                           const std::atomic<bool>* cancel) {
  SheetFacts facts;
  const Result<Json> index = for_each_indexed_video(
      dataset, cancel, [&](const IndexedVideo& video, pugi::xml_node annotations) -> Result<void> {
        add_video(dataset, video, annotations, facts);
        return {};
      });
  if (!index) return fail(index.error());
  const Json recipe = member(*index, "recipe");
  Json sheet{{"sigs_data_sheet", 1}};
  for (const char* const key : {"name", "program", "seed", "recipe_sha256", "checksum", "settings"})
    sheet[key] = member(*index, key);
  sheet["about"] = member(recipe, "about");
  sheet["counts"] = counts_json(facts);
  sheet["impossible"] = member(*index, "impossible").size();
  SheetChecksums checksums(cancel);
  sheet["footage"] = Json::array();
  for (const Json& background : named_in(recipe, "backgrounds"))
    sheet["footage"].push_back(
        footage_json(background.at("name"), background, facts, guesses, member(*index, "measured"), checksums));
  sheet["aircraft"] = Json::array();
  for (const Json& aircraft : named_in(recipe, "aircraft"))
    sheet["aircraft"].push_back(aircraft_json(aircraft, facts, checksums));
  sheet["labels"] = labels_json(facts);
  if (const Result<void> on = check_interrupt(cancel); !on) return fail(on.error());
  return sheet;
}

}  // namespace sigs

// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include "base/text.h"
#include "dataset/data_sheet.h"

namespace sigs {

namespace {

// A value for people: texts on one line, "not stated" for null.
std::string shown_value(const Json& value) {
  if (value.is_null()) return "not stated";
  if (value.is_string()) return line_text(value.get<std::string>());
  if (value.is_number_float()) return short_number_text(value.get<double>());
  return value.dump();
}

// In a cell of a table.
std::string cell(const Json& value) {
  std::string text;
  for (const char c : shown_value(value)) text += c == '|' ? std::string("\\|") : std::string(1, c);
  return text;
}

std::string row(const std::vector<std::string>& cells) {
  return "| " + listed(cells, " | ") + " |\n";
}

std::string head(const std::vector<std::string>& cells) {
  std::string rule = "|";
  for (std::size_t i = 0; i < cells.size(); ++i) rule += "---|";
  return row(cells) + rule + "\n";
}

std::string whole_part(const Json& sheet) {
  std::string text = fmt::format("# Data sheet of {}\n\n", shown_value(sheet.at("name")));
  if (sheet.at("about").is_string()) text += shown_value(sheet.at("about")) + "\n\n";
  text += head({"", ""});
  for (const auto& [key, title] : {std::pair{"program", "made by"},
                                   {"seed", "seed"},
                                   {"recipe_sha256", "SHA-256 of the recipe"},
                                   {"checksum", "checksum of the dataset (SHA-256 of SHA256SUMS)"},
                                   {"impossible", "videos of the recipe that are impossible"}})
    text += row({title, cell(sheet.at(key))});
  const Json& settings = sheet.at("settings");
  return text + row({"settings beside the recipe", settings.is_array() && settings.empty() ? "none" : cell(settings)});
}

std::string counts_part(const Json& counts) {
  std::string text = "\n## Numbers\n\n";
  text += head({"split", "videos", "frames", "intruders", "distractors", "frames with an intruder in view"});
  const auto count_row = [&](const std::string& name, const Json& count) {
    return row({name, cell(count.at("videos")), cell(count.at("frames")), cell(count.at("intruders")),
                cell(count.at("distractors")), cell(count.at("intruder_frames"))});
  };
  for (const auto& [name, count] : counts.at("splits").items()) text += count_row(line_text(name), count);
  text += count_row("sum", counts.at("all"));
  text += "\n" + head({"category", "videos", "intruders", "distractors", "frames with an intruder in view"});
  for (const auto& [name, count] : counts.at("categories").items())
    text += row({line_text(name), cell(count.at("videos")), cell(count.at("intruders")), cell(count.at("distractors")),
                 cell(count.at("intruder_frames"))});
  return text + "\nAn intruder counts once in each video; two in one frame count twice.\n";
}

// A key that a sheet has of backgrounds of which some video was made.
Json known(const Json& object, const char* key) {
  return object.contains(key) ? object.at(key) : Json(nullptr);
}

std::string footage_part(const Json& footage) {
  std::string text = "\n## Footage\n\n";
  text += head({"background", "file", "size", "frames a second", "frames used", "licence", "source", "SHA-256"});
  for (const Json& one : footage) {
    const std::string size = one.contains("width") ? fmt::format("{} x {}", cell(one["width"]), cell(one["height"]))
                                                   : std::string("not used");
    text += row({cell(one.at("background")), cell(known(one, "video")), size, cell(known(one, "frame_rate")),
                 one.contains("frames") ? cell(one["frames"]) : "0", cell(one.at("licence")), cell(one.at("source")),
                 known(one, "sha256").is_null() ? "file not found" : cell(one["sha256"])});
  }
  text += "\n" + head({"background", "calibration", "reprojection error, px", "attitude of the camera"});
  for (const Json& one : footage) {
    const Json calibration = known(one, "calibration");
    text += row({cell(one.at("background")), cell(known(calibration, "file")),
                 cell(known(calibration, "reprojection_error_px")), cell(known(one, "camera_attitude"))});
  }
  return text;
}

std::string aircraft_part(const Json& aircraft) {
  std::string text = "\n## Aircraft\n\n";
  text += head({"name", "category", "role", "model", "licence", "source", "SHA-256"});
  for (const Json& one : aircraft)
    text +=
        row({cell(one.at("name")), cell(one.at("category")), one.at("distractor") == true ? "distractor" : "intruder",
             one.at("model").is_null() ? "not used" : cell(one.at("model")), cell(one.at("licence")),
             cell(one.at("source")), one.at("sha256").is_null() ? "file not found" : cell(one.at("sha256"))});
  return text;
}

std::string labels_part(const Json& labels) {
  const Json& sd = labels.at("attitude_sd");
  std::string text =
      "\n## Labels\n\n- Formats: " + listed(labels.at("formats").get<std::vector<std::string>>()) + ".\n";
  text +=
      "- Boxes and masks are measured on the rendered coverage of each intruder, so they agree with the pixels that "
      "were "
      "composited. A pixel counts from 1/64 of the coverage of the most covered pixel on; a side of a box may lie up "
      "to "
      "a pixel inside the silhouette.\n"
      "- Positions, ranges and attitudes of intruders are those by which they were rendered. They are exact for the "
      "camera as it is stated; errors of its calibration and attitude are errors against the footage.\n";
  text += fmt::format("- Standard deviation of the camera's attitude: stated in {} of {} frames",
                      sd.at("frames_stated").dump(), sd.at("frames").dump());
  if (!sd.at("lowest_deg").is_null())
    text += fmt::format(", the largest of three axes from {} to {} degrees", shown_value(sd.at("lowest_deg")),
                        shown_value(sd.at("highest_deg")));
  text += fmt::format("; the attitude is unknown in {} of them.\n", sd.at("frames_unknown").dump());
  return text;
}

std::string assumed_part(const Json& sheet) {
  std::string text = "\n## What is assumed, guessed or not known\n\n";
  const std::size_t before = text.size();
  for (const Json& one : sheet.at("footage")) {
    const std::string name = shown_value(one.at("background"));
    if (const Json clouds = known(one, "assumed_cloud_distance_m"); !clouds.is_null())
      text += fmt::format("- {}: the distance of its clouds is assumed, {} m in its first video.\n", name,
                          shown_value(clouds));
    if (one.contains("frames_without_horizon") && one["frames_without_horizon"] != 0)
      text += fmt::format(
          "- {}: the camera's attitude is not known in {} of {} frames; they tell no side of the horizon.\n", name,
          one["frames_without_horizon"].dump(), one["frames"].dump());
    if (const Json look = known(one, "measured"); !look.is_null()) {
      std::vector<std::string> not_shown;
      for (const Json& quantity : known(look, "not_shown")) not_shown.push_back(shown_value(quantity));
      text += fmt::format("- {}: appearance and light were measured in its frames{}.\n", name,
                          not_shown.empty() ? "" : "; not shown there, so left at defaults: " + listed(not_shown));
    }
    const Json& guessed = one.at("guessed");
    if (guessed.is_array())
      for (const Json& guess : guessed) text += fmt::format("- {}: guessed: {}\n", name, shown_value(guess));
    else if (one.at("made_by_init") == true)
      text += fmt::format("- {}: taken from a project; notes on what was guessed of it were not found.\n", name);
  }
  const Json& clouds = sheet.at("labels").at("cloud_distances_m");
  if (!clouds.empty())
    text += fmt::format("- Labels state {} assumed distances of clouds, from {} to {} m.\n", clouds.size(),
                        shown_value(clouds.front()), shown_value(clouds.back()));
  return text.size() == before ? text + "Nothing is marked as assumed or guessed.\n" : text;
}

}  // namespace

std::string data_sheet_text(const Json& sheet) {
  return whole_part(sheet) + counts_part(sheet.at("counts")) + footage_part(sheet.at("footage")) +
         aircraft_part(sheet.at("aircraft")) + labels_part(sheet.at("labels")) + assumed_part(sheet);
}

}  // namespace sigs

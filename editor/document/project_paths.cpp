// SPDX-License-Identifier: MIT
#include "editor/document/project_paths.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>
#include <numbers>
#include <set>
#include <string_view>
#include <utility>

#include "base/input_file.h"
#include "base/numbered_files.h"
#include "base/paths.h"
#include "camera/camera.h"
#include "project/fields.h"
#include "video/image_sequence.h"

namespace sigs::editor {

namespace {

namespace fs = std::filesystem;

fs::path normal(const fs::path& path) {
  return fs::absolute(path).lexically_normal();
}

bool is_file(const fs::path& path) {
  std::error_code code;
  return fs::is_regular_file(path, code);
}

// Whether what a field names is there. Footage may be a folder of images or a pattern of their names, a calibration the
// camera of a rig ("rig.yaml#cam1").
bool is_there(std::string_view field, const fs::path& place) {
  if (field.ends_with("footage.video") && is_image_sequence(place)) return files_of_sequence(place).has_value();
  return is_file(field.ends_with("footage.calibration") ? calibration_name(place).file : place);
}

// A folder that moved, at its old and its new place.
struct Move {
  fs::path from;
  fs::path to;
};

// From the largest part of the tree that may have moved down to the file's own folder.
std::vector<Move> moves_of(const fs::path& from, const fs::path& to) {
  std::vector<Move> moves{{from.parent_path(), to.parent_path()}};
  fs::path a = from;
  fs::path b = to;
  while (a.has_relative_path() && b.has_relative_path() && a.filename() == b.filename()) {
    a = a.parent_path();
    b = b.parent_path();
    moves.push_back({a, b});
  }
  std::ranges::reverse(moves);
  return moves;
}

fs::path place_after(const std::vector<Move>& moves, const MissingFile& missing) {
  for (const Move& move : moves) {
    const fs::path candidate = (move.to / missing.place.lexically_relative(move.from)).lexically_normal();
    if (is_there(missing.field, candidate)) return candidate;
  }
  const fs::path beside = moves.back().to / missing.place.filename();
  return is_there(missing.field, beside) ? beside : fs::path();
}

using namespace std::string_view_literals;

constexpr double kAhead_m = 300;

std::string first_bytes(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  std::string bytes(4096, '\0');
  in.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  bytes.resize(static_cast<std::size_t>(std::max<std::streamsize>(0, in.gcount())));
  return bytes;
}

bool at(std::string_view bytes, std::size_t offset, std::string_view mark) {
  return bytes.size() >= offset && bytes.substr(offset).starts_with(mark);
}

bool is_image(std::string_view bytes) {
  return at(bytes, 0, "\x89PNG"sv) || at(bytes, 0, "\xFF\xD8\xFF"sv) || at(bytes, 0, "BM"sv) ||
         at(bytes, 0, "II*\0"sv) || at(bytes, 0, "MM\0*"sv) || (at(bytes, 0, "RIFF"sv) && at(bytes, 8, "WEBP"sv));
}

// ISO media, AVI, Matroska and WebM, MPEG-2 transport streams, MPEG program streams, Ogg.
bool is_video(std::string_view bytes) {
  return at(bytes, 4, "ftyp"sv) || at(bytes, 4, "moov"sv) || (at(bytes, 0, "RIFF"sv) && at(bytes, 8, "AVI "sv)) ||
         at(bytes, 0, "\x1A\x45\xDF\xA3"sv) || (at(bytes, 0, "G"sv) && at(bytes, 188, "G"sv)) ||
         at(bytes, 0, "\0\0\1\xBA"sv) || at(bytes, 0, "OggS"sv);
}

// One of them may begin with a byte order mark or empty lines.
std::string_view without_blanks(std::string_view bytes) {
  if (bytes.starts_with("\xEF\xBB\xBF"sv)) bytes.remove_prefix(3);
  const std::size_t begin = bytes.find_first_not_of(" \t\r\n");
  return begin == std::string_view::npos ? std::string_view() : bytes.substr(begin);
}

DroppedKind kind_by_content(std::string_view bytes) {
  if (is_image(bytes)) return DroppedKind::mask;
  if (is_video(bytes)) return DroppedKind::video;
  const std::string_view text = without_blanks(bytes);
  if (text.starts_with("{"))
    return text.find("\"sigs\"") != std::string_view::npos ? DroppedKind::project : DroppedKind::calibration;
  // Lists of detections (AOT); no calibration is a list.
  if (text.starts_with("[")) return DroppedKind::results;
  if (text.starts_with("%YAML") || text.find("<opencv_storage") != std::string_view::npos)
    return DroppedKind::calibration;
  return DroppedKind::nothing;
}

DroppedKind kind_by_extension(const std::string& extension) {
  static const std::map<DroppedKind, std::set<std::string_view>> kExtensions{
      {DroppedKind::video,
       {".mp4", ".mov", ".mkv", ".avi", ".webm", ".m4v", ".mts", ".m2ts", ".ts", ".mpg", ".mpeg", ".wmv", ".y4m"}},
      {DroppedKind::model, {".obj"}},
      {DroppedKind::calibration, {".xml", ".yaml", ".yml"}},
      {DroppedKind::mask, {".png", ".pgm"}},
      {DroppedKind::project, {".json"}},
      {DroppedKind::results, {".txt", ".csv"}}};
  for (const auto& [kind, extensions] : kExtensions)
    if (extensions.contains(extension)) return kind;
  return DroppedKind::nothing;
}

void put_model(Project& project, const fs::path& path, const Selection& selection) {
  const std::string file = path_in_project(project, path);
  const bool of_intruder = selection.kind == Selected::intruder || selection.kind == Selected::waypoint;
  const auto selected = static_cast<std::size_t>(selection.intruder);
  if (of_intruder && selection.intruder >= 0 && selected < project.intruders.size()) {
    project.intruders[selected].model.file = file;
    return;
  }
  const double yaw_rad = project.camera.yaw_deg * std::numbers::pi / 180;
  const glm::dvec3 ahead_m{kAhead_m * std::cos(yaw_rad), kAhead_m * std::sin(yaw_rad), 0};
  IntruderSettings intruder{.name = path.stem().string()};
  intruder.model.file = file;
  intruder.trajectory.waypoints = {{.frame = {}, .position_m = project.camera.position_m + ahead_m}};
  project.intruders.push_back(std::move(intruder));
}

}  // namespace

std::vector<MissingFile> missing_files(const Project& project) {
  Project copy = project;
  std::vector<MissingFile> missing;
  for (const Field& field : fields_of(copy)) {
    if (!field.is_path) continue;
    const std::string& path = *std::get<std::string*>(field.value);
    if (path.empty()) continue;
    const fs::path place = normal(resolved(project, path));
    if (!is_there(field.key, place)) missing.push_back({field.key, path, place});
  }
  return missing;
}

std::vector<Relinked> suggested_places(const std::vector<MissingFile>& missing, const MissingFile& found,
                                       const fs::path& new_place) {
  const fs::path to = normal(new_place);
  const std::vector<Move> moves = moves_of(found.place, to);
  std::vector<Relinked> suggested;
  for (const MissingFile& other : missing) {
    if (other.field == found.field) continue;
    const fs::path place = other.place == found.place ? to : place_after(moves, other);
    if (is_there(other.field, place)) suggested.push_back({other.field, place});
  }
  return suggested;
}

fs::path place_at(const MissingFile& missing, const fs::path& chosen) {
  if (missing.field.ends_with("footage.calibration"))
    if (const std::string camera = calibration_name(missing.place).camera; !camera.empty())
      return fs::path(chosen) += "#" + camera;
  const fs::path pattern = chosen.parent_path() / missing.place.filename();
  const bool is_of_pattern = missing.field.ends_with("footage.video") && is_number_pattern(pattern);
  return is_of_pattern && files_of_sequence(pattern) ? pattern : chosen;
}

void relink(Project& project, const std::vector<Relinked>& places) {
  for (const Field& field : fields_of(project)) {
    const auto place = std::ranges::find(places, field.key, &Relinked::field);
    if (place != places.end() && field.is_path)
      *std::get<std::string*>(field.value) = path_in_project(project, place->place);
  }
}

Project moved_to(Project project, const fs::path& file) {
  const bool had_file = !project.file.empty();
  const fs::path folder = normal(file).parent_path();
  const fs::path old_folder = normal(project.file.empty() ? fs::path("project.json") : project.file).parent_path();
  project.file = file;
  if (had_file && folder == old_folder) return project;
  for (const Field& field : fields_of(project)) {
    if (!field.is_path) continue;
    std::string& path = *std::get<std::string*>(field.value);
    if (path.empty()) continue;
    if (fs::path(path).is_absolute()) {
      if (!had_file) path = path_in_project(project, path);
      continue;
    }
    path = (old_folder / path).lexically_normal().lexically_relative(folder).generic_string();
  }
  return project;
}

std::string path_in_project(const Project& project, const fs::path& file) {
  const fs::path target = normal(file);
  if (project.file.empty()) return target.generic_string();
  const fs::path relative = target.lexically_relative(normal(project.file).parent_path());
  const auto steps_up = std::ranges::count(relative, fs::path(".."));
  constexpr int kMaxStepsUp = 4;
  return (relative.empty() || steps_up > kMaxStepsUp ? target : relative).generic_string();
}

fs::path file_beside(const Project& project, const std::string& ending, const std::string& extension) {
  const fs::path beside = !project.file.empty()            ? project.file
                          : !project.footage.video.empty() ? resolved(project, project.footage.video)
                                                           : fs::path(project.name);
  const std::string camera = project.rig_view ? "." + project.rig_view->name : std::string();
  return fs::absolute(beside.parent_path() / (beside.stem().string() + camera + ending + extension)).lexically_normal();
}

fs::path new_file_beside(const Project& project, const std::string& ending, const std::string& extension) {
  std::error_code code;
  fs::path file = file_beside(project, ending, extension);
  for (int number = 2; fs::exists(file, code); ++number)
    file = file_beside(project, ending + "_" + std::to_string(number), extension);
  return file;
}

DroppedFile classified_drop(const fs::path& path) {
  std::error_code code;
  const auto nothing = [&](const std::string& why) { return DroppedFile{DroppedKind::nothing, path, why}; };
  if (fs::is_directory(path, code)) return nothing(path.string() + " is a folder; drop a file");
  if (!fs::exists(path, code)) return nothing(path.string() + " is not there");
  if (const Result<void> file = check_input_file(path); !file)
    return nothing(file.error().where + " " + file.error().what);
  if (!std::ifstream(path, std::ios::binary)) return nothing(path.string() + " cannot be read");
  // An OBJ is text without a mark of its own: its name has to say it.
  const std::string extension = lower_extension(path);
  const DroppedKind content = extension == ".obj" ? DroppedKind::model : kind_by_content(first_bytes(path));
  const DroppedKind kind = content != DroppedKind::nothing ? content : kind_by_extension(extension);
  if (kind == DroppedKind::nothing)
    return nothing(path.filename().string() +
                   " is neither project, video, calibration, OBJ model, mask image nor results of a tracker; nothing "
                   "was changed");
  return {kind, path, {}};
}

std::optional<ChangeProject> change_by(const DroppedFile& dropped, const Selection& selection) {
  const fs::path& path = dropped.path;
  if (dropped.kind == DroppedKind::model)
    return ChangeProject{"drop model", [path, selection](Project& p) { put_model(p, path, selection); }, {}};
  const auto set = [&path](const char* name, std::string FootageSettings::*place) {
    return ChangeProject{name, [path, place](Project& p) { p.footage.*place = path_in_project(p, path); }, {}};
  };
  if (dropped.kind == DroppedKind::video) return set("set footage", &FootageSettings::video);
  if (dropped.kind == DroppedKind::calibration) return set("set calibration", &FootageSettings::calibration);
  if (dropped.kind == DroppedKind::mask) return set("set own-body mask", &FootageSettings::own_body_mask);
  return std::nullopt;
}

}  // namespace sigs::editor

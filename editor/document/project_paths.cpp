// SPDX-License-Identifier: MIT
#include "editor/document/project_paths.h"

#include <algorithm>
#include <utility>

#include "project/fields.h"

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
  std::reverse(moves.begin(), moves.end());
  return moves;
}

fs::path place_after(const std::vector<Move>& moves, const fs::path& old_place) {
  for (const Move& move : moves) {
    const fs::path candidate = (move.to / old_place.lexically_relative(move.from)).lexically_normal();
    if (is_file(candidate)) return candidate;
  }
  const fs::path beside = moves.back().to / old_place.filename();
  return is_file(beside) ? beside : fs::path();
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
    if (!is_file(place)) missing.push_back({field.key, path, place});
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
    const fs::path place = other.place == found.place ? to : place_after(moves, other.place);
    if (is_file(place)) suggested.push_back({other.field, place});
  }
  return suggested;
}

void relink(Project& project, const std::vector<Relinked>& places) {
  for (const Field& field : fields_of(project)) {
    const auto place = std::find_if(places.begin(), places.end(),
                                    [&](const Relinked& relinked) { return relinked.field == field.key; });
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
  const auto steps_up = std::count(relative.begin(), relative.end(), fs::path(".."));
  constexpr int kMaxStepsUp = 4;
  return (relative.empty() || steps_up > kMaxStepsUp ? target : relative).generic_string();
}

}  // namespace sigs::editor

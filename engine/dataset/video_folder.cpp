// SPDX-License-Identifier: MIT
#include "dataset/video_folder.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <system_error>
#include <utility>

#include "base/paths.h"
#include "base/staged_outputs.h"
#include "dataset/dataset_lock.h"
#include "export/export_project.h"
#include "project/fields.h"
#include "project/json.h"
#include "project/project.h"

namespace sigs {

namespace fs = std::filesystem;

namespace {

std::string project_name(const PlannedVideo& video) {
  return video.name + ".json";
}

// Symbolic links among the folders above a file are followed, the file's own name stays.
fs::path without_links(const fs::path& file) {
  std::error_code code;
  const fs::path folder = fs::weakly_canonical(file.parent_path(), code);
  return code ? file : folder / file.filename();
}

Project with_relative_paths(const VideoFolder& folder) {
  const Project& planned = folder.video->rig ? *folder.video->rig : folder.video->project;
  Project project = planned;
  for (const Field& field : fields_of(project)) {
    if (!field.is_path) continue;
    std::string& path = *std::get<std::string*>(field.value);
    if (path.empty()) continue;
    path = without_links(resolved(planned, path)).lexically_relative(folder.path()).generic_string();
  }
  project.file = folder.path() / project_name(*folder.video);
  return project;
}

// Errors name the project's final place; files are written elsewhere.
Project with_absolute_paths(const VideoFolder& folder) {
  Project project = folder.video->project;
  for (const Field& field : fields_of(project))
    if (field.is_path)
      if (std::string& path = *std::get<std::string*>(field.value); !path.empty())
        path = resolved(folder.video->project, path).string();
  project.file = project_name(*folder.video);
  return project;
}

Result<VideoEntry> export_into(const fs::path& staged, const VideoFolder& folder, const VideoExport& request) {
  const ExportRequest wanted{
      .project = with_absolute_paths(folder), .folder = staged, .jobs = request.jobs, .footage = request.footage};
  const ExportControl control{
      .progress = request.progress,
      .warn =
          [&](const Warning& warning) {
            const std::string& video = folder.video->name;
            if (request.warn)
              request.warn({warning.where.empty() ? video : video + ": " + warning.where, warning.what});
          },
      .cancel = request.cancel};
  const Result<ExportReport> report =
      request.renderer != nullptr ? export_frame(wanted, *request.renderer, control) : export_project(wanted, control);
  if (!report) return fail(report.error());
  ChecksumCache known;
  Result<std::vector<DatasetFile>> files = files_in(staged, {}, known, request.cancel);
  if (!files) return fail(files.error());
  return VideoEntry{.planned = request.planned, .frames = report->frames, .files = std::move(*files)};
}

// The entry comes last: a folder that has one is whole.
Result<void> finish(const fs::path& staged, const VideoFolder& folder, const VideoEntry& entry) {
  Result<void> step = write_text(staged / project_name(*folder.video), text_of(with_relative_paths(folder)), false);
  if (step) step = flush_all(staged);
  if (step) step = write_text(staged / kEntryName, entry_text(*folder.video, entry), false);
  if (step) step = flush(staged / kEntryName);
  return step ? flush(staged) : step;
}

// Why an existing folder may not be replaced by the video; empty: it may.
std::string not_ours(const fs::path& place, const PlannedVideo& video) {
  const Result<VideoEntry> entry = read_entry(place / kEntryName);
  if (!entry)
    return "is there and no video that sigs dataset made; move it away or choose another folder for the dataset";
  const std::optional<std::string> unlisted_file = unlisted_file_in(place, *entry, {kEntryName, project_name(video)});
  if (unlisted_file)
    return fmt::format("is made anew, but holds {}, which sigs dataset did not write; move that away", *unlisted_file);
  return "";
}

Error not_committed(const VideoFolder& folder, const std::error_code& code) {
  return {folder.path().string(), "cannot be given its final name: " + code.message(), ErrorKind::write_failed};
}

// The older folder is moved to the staging folder and checked again: another program may have written into it
// meanwhile.
Result<void> replace(const fs::path& staged, const VideoFolder& folder) {
  const fs::path backup = staging_folder_of(folder.dataset) / "old" / folder.video->name;
  if (const Result<void> step = make_empty(backup); !step) return step;
  const fs::path aside = backup / folder.video->name;
  if (const std::error_code code = replace_with_backup(staged, folder.path(), aside); code)
    return fail(not_committed(folder, code));
  const std::string wrong = not_ours(aside, *folder.video);
  std::error_code code;
  if (!wrong.empty()) code = replace_with_backup(aside, folder.path(), staged);
  if (code) return fail(aside.string(), "cannot be put back: " + code.message(), ErrorKind::write_failed);
  fs::remove_all(backup, code);
  return wrong.empty() ? Result<void>() : fail(folder.path().string(), wrong, ErrorKind::cannot_create);
}

Result<void> commit_video(const fs::path& staged, const VideoFolder& folder) {
  const std::error_code code = rename_new(staged, folder.path());
  if (code && code != std::errc::file_exists) return fail(not_committed(folder, code));
  if (code)
    if (const Result<void> step = replace(staged, folder); !step) return step;
  return flush(folder.dataset);
}

}  // namespace

Project project_of_video(const Project& in_file, const std::map<std::string, std::string>& tags) {
  const auto tag = tags.find("camera");
  if (tag == tags.end()) return in_file;
  const auto camera = std::ranges::find(in_file.cameras, tag->second, &RigCamera::name);
  if (camera == in_file.cameras.end()) return in_file;
  return seen_by(in_file, static_cast<std::size_t>(camera - in_file.cameras.begin()));
}

Result<void> update_metadata(const VideoFolder& folder, const VideoEntry& entry) {
  const std::pair<fs::path, std::string> metadata[] = {
      {folder.path() / project_name(*folder.video), text_of(with_relative_paths(folder))},
      {folder.path() / kEntryName, entry_text(*folder.video, entry)}};
  for (const auto& [file, text] : metadata) {
    if (const Result<std::string> there = read_text(file); there && *there == text) continue;
    if (const Result<void> step = write_text(file, text, true); !step) return step;
  }
  return {};
}

Result<VideoEntry> make_video(const VideoFolder& folder, const VideoExport& request) {
  const fs::path staged = staging_folder_of(folder.dataset) / "new" / folder.video->name;
  std::error_code code;
  if (fs::exists(fs::symlink_status(folder.path(), code)))
    if (const std::string why = not_ours(folder.path(), *folder.video); !why.empty())
      return fail(folder.path().string(), why, ErrorKind::cannot_create);
  if (const Result<void> step = make_empty(staged); !step) return fail(step.error());
  Result<VideoEntry> made = export_into(staged, folder, request);
  Result<void> step;
  if (made) step = finish(staged, folder, *made);
  if (made && step) step = commit_video(staged, folder);
  fs::remove_all(staged, code);
  if (made && !step) return fail(std::move(step.error()));
  return made;
}

}  // namespace sigs

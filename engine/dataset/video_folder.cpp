// SPDX-License-Identifier: MIT
#include "dataset/video_folder.h"

#include <algorithm>
#include <array>
#include <system_error>
#include <utility>

#include "base/flush.h"
#include "base/partial_file.h"
#include "base/renaming.h"
#include "dataset/claim.h"
#include "export.h"
#include "project/fields.h"
#include "project/json.h"

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

Project located(const VideoFolder& folder) {
  Project project = folder.video->project;
  for (const Field& field : fields_of(project)) {
    if (!field.is_path) continue;
    std::string& path = *std::get<std::string*>(field.value);
    if (path.empty()) continue;
    path = without_links(resolved(folder.video->project, path)).lexically_relative(folder.path()).generic_string();
  }
  project.file = folder.path() / project_name(*folder.video);
  return project;
}

Result<void> make_empty(const fs::path& folder) {
  std::error_code code;
  for (int tries = 0; tries < 10; ++tries) {  // another run may tidy the workshop between two steps
    fs::remove_all(folder, code);
    if (!code) fs::create_directories(folder, code);
    if (code != std::errc::no_such_file_or_directory) break;
  }
  if (code) return fail(folder.string(), "cannot be created: " + code.message(), ErrorKind::cannot_create);
  return {};
}

// What is wrong names the project's place; files are written elsewhere.
Project readable_from_anywhere(const VideoFolder& folder) {
  Project project = folder.video->project;
  for (const Field& field : fields_of(project))
    if (field.is_path)
      if (std::string& path = *std::get<std::string*>(field.value); !path.empty())
        path = resolved(folder.video->project, path).string();
  project.file = project_name(*folder.video);
  return project;
}

Result<VideoEntry> export_into(const fs::path& part, const VideoFolder& folder, const VideoExport& request) {
  const ExportRequest wanted{.project = readable_from_anywhere(folder), .folder = part, .jobs = request.jobs};
  const Result<ExportReport> report =
      export_project(wanted, {.progress = request.progress,
                              .warn =
                                  [&](const Warning& warning) {
                                    if (request.warn) request.warn({folder.video->name, warning.text()});
                                  },
                              .cancel = request.cancel});
  if (!report) return fail(report.error());
  KnownFiles known;
  Result<std::vector<DatasetFile>> files = files_in(part, {}, known, request.cancel);
  if (!files) return fail(files.error());
  return VideoEntry{.planned = request.planned, .frames = report->frames, .files = std::move(*files)};
}

// The entry comes last: a folder that has one is whole.
Result<void> finish(const fs::path& part, const VideoFolder& folder, const VideoEntry& entry) {
  Result<void> step = write_text(part / project_name(*folder.video), project_text(folder), false);
  if (step) step = flush_all(part);
  if (step) step = write_text(part / kEntryName, entry_text(*folder.video, entry), false);
  if (step) step = flush(part / kEntryName);
  return step ? flush(part) : step;
}

// Why what lies at a place may not be replaced by the video; empty: it may.
std::string wrong_in(const fs::path& place, const PlannedVideo& video) {
  const Result<VideoEntry> entry = read_entry(place / kEntryName);
  if (!entry) return "is there and no video that sigs dataset made; move it away or choose another --out";
  const std::optional<std::string> stranger = stranger_in(place, *entry, uncounted(video));
  if (stranger) return "is made anew, but holds " + *stranger + ", which sigs dataset did not write; move that away";
  return "";
}

Error not_placed(const VideoFolder& folder, const std::error_code& code) {
  return {folder.path().string(), "cannot be given its final name: " + code.message(), ErrorKind::write_failed};
}

// The older folder lies aside until it was looked at once more: somebody may have put something into it meanwhile.
Result<void> replace(const fs::path& part, const VideoFolder& folder) {
  const fs::path room = workshop_of(folder.dataset) / "old" / folder.video->name;
  if (const Result<void> step = make_empty(room); !step) return step;
  const fs::path aside = room / folder.video->name;
  if (const std::error_code code = replace_keeping(part, folder.path(), aside); code)
    return fail(not_placed(folder, code));
  const std::string wrong = wrong_in(aside, *folder.video);
  std::error_code code;
  if (!wrong.empty()) code = replace_keeping(aside, folder.path(), part);
  if (code) return fail(aside.string(), "cannot be put back: " + code.message(), ErrorKind::write_failed);
  fs::remove_all(room, code);
  return wrong.empty() ? Result<void>() : fail(folder.path().string(), wrong, ErrorKind::cannot_create);
}

Result<void> put_in_place(const fs::path& part, const VideoFolder& folder) {
  const std::error_code code = rename_new(part, folder.path());
  if (code && code != std::errc::file_exists) return fail(not_placed(folder, code));
  if (code)
    if (const Result<void> step = replace(part, folder); !step) return step;
  return flush(folder.dataset);
}

}  // namespace

std::vector<std::string> uncounted(const PlannedVideo& video) {
  return {kEntryName, project_name(video)};
}

std::string project_text(const VideoFolder& folder) {
  return text_of(located(folder));
}

Result<void> update_notes(const VideoFolder& folder, const VideoEntry& entry) {
  const std::pair<fs::path, std::string> notes[] = {{folder.path() / project_name(*folder.video), project_text(folder)},
                                                    {folder.path() / kEntryName, entry_text(*folder.video, entry)}};
  for (const auto& [file, text] : notes) {
    if (const Result<std::string> there = read_text(file); there && *there == text) continue;
    if (const Result<void> step = write_text(file, text, true); !step) return step;
  }
  return {};
}

std::string not_replaceable(const VideoFolder& folder) {
  std::error_code code;
  return fs::exists(fs::symlink_status(folder.path(), code)) ? wrong_in(folder.path(), *folder.video) : "";
}

Result<VideoEntry> make_video(const VideoFolder& folder, const VideoExport& request) {
  const fs::path part = workshop_of(folder.dataset) / "new" / folder.video->name;
  if (const std::string why = not_replaceable(folder); !why.empty())
    return fail(folder.path().string(), why, ErrorKind::cannot_create);
  if (const Result<void> step = make_empty(part); !step) return fail(step.error());
  Result<VideoEntry> made = export_into(part, folder, request);
  Result<void> step;
  if (made) step = finish(part, folder, *made);
  if (made && step) step = put_in_place(part, folder);
  std::error_code code;
  fs::remove_all(part, code);
  return made && !step ? Result<VideoEntry>(fail(step.error())) : made;
}

}  // namespace sigs

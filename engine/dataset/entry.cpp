// SPDX-License-Identifier: MIT
#include "dataset/entry.h"

#include <fmt/format.h>
#include <sys/stat.h>

#include <algorithm>
#include <array>
#include <set>

#include "base/ensure.h"
#include "base/input_file.h"
#include "base/staged_outputs.h"
#include "base/threads.h"
#include "camera/camera.h"
#include "mesh/model_files.h"
#include "project/fields.h"
#include "project/json.h"
#include "video/image_sequence.h"

namespace sigs {

namespace fs = std::filesystem;

Result<std::string> InputChecksums::of(const fs::path& file) {
  const std::lock_guard lock(mutex_);
  if (const auto known = files_.find(file); known != files_.end()) return known->second;
  return files_.emplace(file, checksum_of_file(file, cancel_)).first->second;
}

Result<std::string> InputChecksums::of_all(const Result<std::vector<fs::path>>& files) {
  if (!files) return fail(files.error());
  std::string list;
  for (const fs::path& one : *files) {
    const Result<std::string> checksum = of(one);
    if (!checksum) return checksum;
    list += checksum_line(*checksum, one.filename().string());
  }
  return checksum_of_text(list);
}

Result<std::string> InputChecksums::of_model(const fs::path& file) {
  {
    const std::lock_guard lock(mutex_);
    if (const auto known = models_.find(file); known != models_.end()) return known->second;
  }
  const Result<std::string> checksum = of_all(files_of_model(file));
  if (!checksum) return checksum;
  const std::lock_guard lock(mutex_);
  return models_.emplace(file, checksum).first->second;
}

Result<std::string> InputChecksums::of_images(const fs::path& sequence) {
  return of_all(files_of_sequence(sequence));
}

Result<std::string> fingerprint_of(const Project& project, const std::string& program, InputChecksums& inputs) {
  Project pathless = project;
  std::string list;
  for (const Field& field : fields_of(pathless)) {
    if (!field.is_path) continue;
    std::string& written = *std::get<std::string*>(field.value);
    if (written.empty()) continue;
    fs::path file = resolved(project, written);
    // Of one camera of a rig (rig.yaml#cam1) the file; its name in the list has the camera.
    const std::string name = file.filename().string();
    if (field.key.ends_with("footage.calibration")) file = calibration_name(file).file;
    std::error_code code;
    const bool is_sequence = field.key.ends_with("footage.video") && is_image_sequence(file);
    if (is_sequence || fs::is_regular_file(file, code)) {
      const Result<std::string> checksum = is_sequence                         ? inputs.of_images(file)
                                           : field.key.ends_with("model.file") ? inputs.of_model(file)
                                                                               : inputs.of(file);
      if (!checksum) return fail(checksum.error());
      list += checksum_line(*checksum, field.key);
    }
    written = name;
  }
  return checksum_of_text(fmt::format("{}\n{}{}", program, list, text_of(pathless)));
}

namespace {

Result<std::vector<std::string>> paths_in(const fs::path& folder, const std::vector<std::string>& left_out) {
  std::vector<std::string> paths;
  std::error_code code;
  for (fs::recursive_directory_iterator it(folder, code), end; !code && it != end; it.increment(code)) {
    if (it->is_directory(code) && !it->is_symlink(code)) continue;
    std::string path = it->path().lexically_relative(folder).generic_string();
    if (std::find(left_out.begin(), left_out.end(), path) == left_out.end()) paths.push_back(std::move(path));
  }
  if (code) return fail(folder.string(), "cannot be looked through: " + code.message(), ErrorKind::cannot_read);
  std::sort(paths.begin(), paths.end());
  return paths;
}

VideoEntry entry_of(const Json& json) {
  VideoEntry entry{.planned = json.at("planned").get<std::string>(), .frames = json.at("frames").get<int>()};
  for (const Json& file : json.at("files"))
    entry.files.push_back({.path = file.at("path").get<std::string>(),
                           .bytes = file.at("bytes").get<std::uintmax_t>(),
                           .sha256 = file.at("sha256").get<std::string>()});
  if (json.contains("measured")) entry.look = look_of(json.at("measured"));
  return entry;
}

}  // namespace

Json described(const PlannedVideo& video) {
  Json json;
  json["name"] = video.name;
  json["split"] = video.split;
  json["tags"] = Json::object();
  for (const auto& [key, value] : video.tags) json["tags"][key] = value;
  json["drawn"] = Json::object();
  for (const auto& [key, value] : video.sampled) json["drawn"][key] = value;
  for (const auto& [condition, count] : video.resamples) json["redraws"][condition] = count;
  return json;
}

Json described(const std::vector<DatasetFile>& files, const std::string& before) {
  Json list = Json::array();
  for (const DatasetFile& file : files)
    list.push_back({{"path", before + file.path}, {"bytes", file.bytes}, {"sha256", file.sha256}});
  return list;
}

std::string entry_text(const PlannedVideo& video, const VideoEntry& entry) {
  Json json;
  json["sigs_dataset_entry"] = 1;
  json.update(described(video));
  if (video.look) json["measured"] = described(*video.look);
  json["frames"] = entry.frames;
  json["planned"] = entry.planned;
  json["files"] = described(entry.files, "");
  return json_text(json);
}

Result<VideoEntry> read_entry(const fs::path& file) {
  const Result<std::string> text = read_text(file);
  if (!text) return fail(text.error());
  const Result<Json> json = parsed_json(*text, file.string(), ErrorKind::bad_data);
  if (!json) return fail(json.error());
  try {
    return entry_of(*json);
  } catch (const Json::exception&) {
    return fail(file.string(), "is not the entry of a video that sigs dataset made");
  }
}

std::optional<ChecksumCache::Identity> ChecksumCache::identity_of(const fs::path& file) {
  struct stat state {};
  if (stat(file.c_str(), &state) != 0) return std::nullopt;
  return Identity{state.st_dev, state.st_ino};
}

void ChecksumCache::remember(const fs::path& folder, const VideoEntry& entry) {
  for (const DatasetFile& file : entry.files)
    if (const std::optional<Identity> identity = identity_of(folder / file.path))
      checksums_.emplace(*identity, file.sha256);
}

Result<std::string> ChecksumCache::checksum_of(const fs::path& file, const std::atomic<bool>* cancel) {
  const std::optional<Identity> identity = identity_of(file);
  if (identity)
    if (const auto known = checksums_.find(*identity); known != checksums_.end()) return known->second;
  Result<std::string> checksum = checksum_of_file(file, cancel);
  if (checksum && identity) checksums_.emplace(*identity, *checksum);
  return checksum;
}

Result<std::vector<DatasetFile>> files_in(const fs::path& folder, const std::vector<std::string>& left_out,
                                          ChecksumCache& known, const std::atomic<bool>* cancel) {
  const Result<std::vector<std::string>> paths = paths_in(folder, left_out);
  if (!paths) return fail(paths.error());
  std::vector<DatasetFile> files;
  for (const std::string& path : *paths) {
    std::error_code code;
    const std::uintmax_t bytes = fs::file_size(folder / path, code);
    if (code) return fail((folder / path).string(), "cannot be read: " + code.message(), ErrorKind::cannot_read);
    const Result<std::string> checksum = known.checksum_of(folder / path, cancel);
    if (!checksum) return fail(checksum.error());
    files.push_back({.path = path, .bytes = bytes, .sha256 = *checksum});
  }
  return files;
}

Result<std::string> damage_of(const fs::path& folder, const VideoEntry& entry, const std::atomic<bool>* cancel) {
  for (const DatasetFile& file : entry.files) {  // sizes first: they cost nothing
    std::error_code code;
    const std::uintmax_t bytes = fs::file_size(folder / file.path, code);
    if (code) return file.path + " is missing";
    if (bytes != file.bytes) return file.path + " has another size than when it was made";
  }
  ChecksumCache known;
  for (const DatasetFile& file : entry.files) {
    const Result<std::string> checksum = known.checksum_of(folder / file.path, cancel);
    if (!checksum && checksum.error().kind == ErrorKind::interrupted) return fail(checksum.error());
    if (!checksum) return checksum.error().text();
    if (*checksum != file.sha256) return file.path + " has changed since it was made";
  }
  return std::string();
}

std::optional<std::string> unlisted_file_in(const fs::path& folder, const VideoEntry& entry,
                                            const std::vector<std::string>& left_out) {
  const Result<std::vector<std::string>> paths = paths_in(folder, left_out);
  if (!paths) return std::nullopt;
  std::set<std::string> ours;
  for (const DatasetFile& file : entry.files) ours.insert(file.path);
  for (const std::string& path : *paths)
    if (!ours.contains(path)) return path;
  return std::nullopt;
}

}  // namespace sigs

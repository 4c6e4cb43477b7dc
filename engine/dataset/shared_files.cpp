// SPDX-License-Identifier: MIT
#include "dataset/shared_files.h"

#include <optional>
#include <string>
#include <system_error>
#include <vector>

#include "base/staged_outputs.h"
#include "base/text.h"
#include "dataset/checksum.h"
#include "dataset/entry.h"
#include "dataset/json_text.h"
#include "project/json_reading.h"

namespace sigs {

namespace fs = std::filesystem;

namespace {

using Paths = std::vector<std::string>;

Result<void> foreign(const fs::path& file) {
  return fail(file.string(), "is there, and no dataset wrote it; move it away or choose another --out",
              ErrorKind::cannot_create);
}

// Paths that an index names; none: it is no dataset's.
std::optional<Paths> paths_of_index(const std::string& text) {
  const Result<Json> json = parsed_json(text, kIndexName, ErrorKind::bad_data);
  if (!json || !json->contains("sigs_dataset_index")) return std::nullopt;
  try {
    Paths paths;
    for (const Json& file : json->at("shared_files")) paths.push_back(file.at("path").get<std::string>());
    return paths;
  } catch (const Json::exception&) {
    return std::nullopt;
  }
}

std::string unescaped(std::string_view name) {
  std::string path;
  for (std::size_t i = 0; i < name.size(); ++i) {
    if (name[i] != '\\' || i + 1 == name.size()) {
      path += name[i];
      continue;
    }
    const char c = name[++i];
    path += c == 'n' ? '\n' : c == 'r' ? '\r' : c;
  }
  return path;
}

// Paths that a list of checksums names, checksum_line() backwards; none: it is no dataset's.
std::optional<Paths> paths_of_checksums(std::string_view text) {
  constexpr std::size_t kDigits = 64;
  const std::string entry = std::string("/") + kEntryName;
  Paths paths;
  bool has_entry = false;
  while (!text.empty()) {
    std::string_view line = next_line(text);
    const bool is_escaped = line.starts_with('\\');
    if (is_escaped) line.remove_prefix(1);
    if (line.find_first_not_of("0123456789abcdef") != kDigits || line.substr(kDigits, 2) != "  ") return std::nullopt;
    const std::string_view name = line.substr(kDigits + 2);
    paths.push_back(is_escaped ? unescaped(name) : std::string(name));
    has_entry = has_entry || paths.back().ends_with(entry);
  }
  return has_entry ? std::optional(paths) : std::nullopt;
}

// What a dataset is known to have written; error: a file that tells it is somebody else's.
Result<Paths> known_paths(const fs::path& dataset) {
  Paths known;
  std::error_code code;
  const Result<std::string> index = read_text(dataset / kIndexName);
  const std::optional<Paths> indexed = index ? paths_of_index(*index) : std::nullopt;
  if (!indexed && fs::exists(fs::symlink_status(dataset / kIndexName, code)))
    return fail(foreign(dataset / kIndexName).error());
  if (indexed) known = *indexed;
  const Result<std::string> checksums = read_text(dataset / kChecksumsName);
  const std::optional<Paths> listed = checksums ? paths_of_checksums(*checksums) : std::nullopt;
  if (listed) known.insert(known.end(), listed->begin(), listed->end());
  if (!listed && !indexed && fs::exists(fs::symlink_status(dataset / kChecksumsName, code)))
    return fail(foreign(dataset / kChecksumsName).error());
  return known;
}

// The files of FOLDER/NAME among the paths, as unlisted_file_in() takes them.
VideoEntry files_below(const std::string& name, const Paths& paths) {
  VideoEntry entry;
  for (const std::string& path : paths)
    if (path.starts_with(name + "/")) entry.files.push_back({.path = path.substr(name.size() + 1)});
  return entry;
}

}  // namespace

Result<void> check_shared_files(const fs::path& dataset) {
  const Result<Paths> known = known_paths(dataset);
  if (!known) return fail(known.error());
  for (const char* const name : kSharedFolders) {
    std::error_code code;
    if (fs::exists(dataset / name, code) && !fs::is_directory(dataset / name, code)) return foreign(dataset / name);
    const std::optional<std::string> unlisted_file = unlisted_file_in(dataset / name, files_below(name, *known), {});
    if (unlisted_file) return foreign(dataset / name / *unlisted_file);
  }
  return {};
}

Result<void> remove_index(const fs::path& dataset) {
  if (const Result<void> checked = check_shared_files(dataset); !checked) return checked;
  for (const char* const name : {kIndexName, kSharedFolders[0], kSharedFolders[1], kChecksumsName}) {
    std::error_code code;
    fs::remove_all(dataset / name, code);
    if (code && code != std::errc::no_such_file_or_directory)  // another shard of it may be doing the same
      return fail((dataset / name).string(), "cannot be removed: " + code.message(), ErrorKind::cannot_create);
  }
  return {};
}

}  // namespace sigs

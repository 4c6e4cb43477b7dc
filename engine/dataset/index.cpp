// SPDX-License-Identifier: MIT
#include "dataset/index.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <pugixml.hpp>
#include <system_error>

#include "base/json.h"
#include "base/paths.h"
#include "base/staged_outputs.h"
#include "base/text.h"
#include "base/threads.h"
#include "dataset/dataset_lock.h"
#include "dataset/merge_labels.h"
#include "project/project.h"

namespace sigs {

namespace fs = std::filesystem;

namespace {

using Paths = std::vector<std::string>;

Result<void> foreign(const fs::path& file) {
  return fail(file.string(), "is there, and no dataset wrote it; move it away or choose another folder for the dataset",
              ErrorKind::cannot_create);
}

// Paths that an index names; none: no dataset has written it.
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

// Paths that a list of checksums names, the inverse of checksum_line(); none: no dataset has written it.
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

// What a dataset is known to have written; error: an index or list of checksums that no dataset has written.
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

Result<void> write_splits(const fs::path& folder, const std::vector<FinishedVideo>& videos) {
  for (const std::string& split : splits_of(videos)) {
    std::string list;
    for (const FinishedVideo& one : videos)
      if (split_of(*one.video) == split) list += one.video->name + "\n";
    if (const Result<void> step = write_text(folder / (split + ".txt"), list, false); !step) return step;
  }
  return {};
}

// An empty folder in the staging folder, which becomes FOLDER/NAME.
Result<fs::path> emptied_staging_folder(const fs::path& dataset, const std::string& name) {
  const fs::path folder = staging_folder_of(dataset) / name;
  if (const Result<void> step = make_empty(folder); !step) return fail(step.error());
  return folder;
}

// Moves an output from the staging folder to its final place, which is free; an empty folder is not moved.
Result<void> commit(const fs::path& dataset, const std::string& name) {
  const fs::path made = staging_folder_of(dataset) / name;
  if (const Result<void> step = flush_all(made); !step) return step;
  std::error_code code;
  if (fs::is_empty(made, code))
    fs::remove(made, code);
  else if (!code)
    fs::rename(made, dataset / name, code);
  if (code) return fail((dataset / name).string(), "cannot be written: " + code.message(), ErrorKind::write_failed);
  return {};
}

// A file of the dataset's own, whose final name is free: it gets that name when it is on the disk.
Result<void> write_dataset_file(const fs::path& dataset, const std::string& name, const std::string& text) {
  const Result<fs::path> staging = emptied_staging_folder(dataset, "new");
  if (!staging) return fail(staging.error());
  if (const Result<void> step = write_text(*staging / name, text, false); !step) return step;
  std::error_code code = rename_new(*staging / name, dataset / name);
  if (code) return fail((dataset / name).string(), "cannot be written: " + code.message(), ErrorKind::write_failed);
  fs::remove(*staging, code);
  return {};
}

// Files of splits/ and labels/, made in the staging folder.
Result<std::vector<DatasetFile>> shared_files(const Plan& plan, const fs::path& dataset,
                                              const std::vector<FinishedVideo>& videos,
                                              const std::atomic<bool>* cancel) {
  const Result<fs::path> splits = emptied_staging_folder(dataset, "splits");
  if (!splits) return fail(splits.error());
  const Result<fs::path> labels = emptied_staging_folder(dataset, "labels");
  if (!labels) return fail(labels.error());
  Result<void> step = write_splits(*splits, videos);
  if (step) step = merge_labels({.dataset = dataset, .folder = *labels, .name = plan.name, .cancel = cancel}, videos);
  if (!step) return fail(step.error());
  ChecksumCache known;
  for (const FinishedVideo& one : videos) known.remember(dataset / one.video->name, one.entry);
  std::vector<DatasetFile> files;
  for (const std::string name : kSharedFolders) {
    Result<std::vector<DatasetFile>> found = files_in(staging_folder_of(dataset) / name, {}, known, cancel);
    if (!found) return found;
    for (DatasetFile& file : *found) {
      file.path = name + "/" + file.path;
      files.push_back(std::move(file));
    }
  }
  return files;
}

std::string checksums_of(const std::vector<FinishedVideo>& videos, const std::vector<DatasetFile>& shared) {
  std::string text;
  for (const FinishedVideo& one : videos) {
    const std::string folder = one.video->name + "/";
    for (const DatasetFile& file : one.entry.files) text += checksum_line(file.sha256, folder + file.path);
    text += checksum_line(checksum_of_text(entry_text(*one.video, one.entry)), folder + kEntryName);
  }
  for (const DatasetFile& file : shared) text += checksum_line(file.sha256, file.path);
  return text;
}

Json described(const DatasetSource& source) {
  Json json;
  json["program"] = source.program;
  json["seed"] = source.seed;
  json["recipe_sha256"] = checksum_of_text(source.recipe);
  json["recipe"] = Json::parse(source.recipe, nullptr, false, true);
  if (json["recipe"].is_discarded()) json["recipe"] = nullptr;
  json["settings"] = source.settings;
  return json;
}

Json index_of(const Plan& plan, const DatasetSource& source, const std::vector<FinishedVideo>& videos) {
  Json json;
  json["sigs_dataset_index"] = 1;
  json["name"] = plan.name;
  json.update(described(source));
  int frames = 0;
  for (const FinishedVideo& one : videos) frames += one.entry.frames;
  json["frames"] = frames;
  for (const FinishedVideo& one : videos)  // all of a background have the same look
    if (one.video->look) json["measured"][one.video->tags.at("background")] = described(*one.video->look);
  json["videos"] = Json::array();
  for (const FinishedVideo& one : videos) {
    Json video = described(*one.video);
    video["frames"] = one.entry.frames;
    video["project"] = fmt::format("{}/{}.json", one.video->name, one.video->name);
    video["planned"] = one.entry.planned;
    video["files"] = described(one.entry.files, one.video->name + "/");
    json["videos"].push_back(std::move(video));
  }
  std::vector<const PlannedVideo*> planned;
  for (const PlannedVideo& video : plan.videos) planned.push_back(&video);
  for (const auto& [condition, count] : resamples_of(planned)) json["redraws"][condition] = count;
  json["impossible"] = Json::array();
  for (const ImpossibleVideo& one : plan.impossible)
    json["impossible"].push_back({{"name", one.name}, {"why", one.why}});
  return json;
}

// file: the index, named in errors.
Result<std::vector<IndexedVideo>> videos_in_index(const Json& index, const fs::path& file) {
  if (!index.is_object() || !index.contains("videos") || !index.at("videos").is_array())
    return fail(file.string(), "is no index of a dataset: it has no list \"videos\"");
  std::vector<IndexedVideo> videos;
  for (const Json& video : index.at("videos")) {
    const auto name = video.is_object() ? video.find("name") : video.end();
    if (!video.is_object() || name == video.end() || !name->is_string())
      return fail(file.string(), fmt::format("videos[{}] has no name", videos.size()));
    videos.push_back({.name = name->get<std::string>()});
    IndexedVideo& read = videos.back();
    if (const std::string wrong = wrong_with_video_name(read.name); !wrong.empty())
      return fail(file.string(), fmt::format("videos[{}].name {}", videos.size() - 1, wrong));
    if (const auto split = video.find("split"); split != video.end() && split->is_string())
      read.split = split->get<std::string>();
    if (const auto tags = video.find("tags"); tags != video.end() && tags->is_object())
      for (const auto& [tag, value] : tags->items())
        if (value.is_string()) read.tags[tag] = value.get<std::string>();
    if (const auto drawn = video.find("drawn"); drawn != video.end() && drawn->is_object())
      for (const auto& [quantity, number] : drawn->items())
        if (number.is_number()) read.sampled[quantity] = number.get<double>();
  }
  return videos;
}

Result<pugi::xml_document> annotations_of(const fs::path& file) {
  const Result<std::string> text = read_text(file);
  if (!text)
    return fail(text.error().where, text.error().what + "; counting needs annotations: export.labels with xml",
                text.error().kind);
  pugi::xml_document document;
  const pugi::xml_parse_result parsed = document.load_buffer(text->data(), text->size());
  if (!parsed || !document.child("sigs")) return fail(file.string(), "is no SIGS annotation file");
  return document;
}

// Of the intruders of a project file, by id. Empty where it cannot be read.
std::map<std::string, std::string> categories_of(const fs::path& project) {
  std::map<std::string, std::string> categories;
  const Result<std::string> text = read_text(project);
  const Result<Json> json = text ? parsed_json(*text, project.string(), ErrorKind::bad_data) : fail(text.error());
  if (!json || !json->is_object() || !json->contains("intruders")) return categories;
  std::size_t id = 0;
  for (const Json& intruder : json->at("intruders")) {
    const auto category = intruder.is_object() ? intruder.find("category") : intruder.end();
    const bool is_given = intruder.is_object() && category != intruder.end() && category->is_string();
    categories[std::to_string(id++)] = is_given ? category->get<std::string>() : IntruderSettings{}.category;
  }
  return categories;
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
    if (code && code != std::errc::no_such_file_or_directory)  // another shard may be doing the same
      return fail((dataset / name).string(), "cannot be removed: " + code.message(), ErrorKind::cannot_create);
  }
  return {};
}

bool is_dataset_folder(const fs::path& folder) {
  std::error_code code;
  if (fs::exists(folder / kIndexName, code) || is_folder(staging_folder_of(folder))) return true;
  const auto is_complete_video = [](const fs::path& path) {
    std::error_code ignored;
    return fs::exists(path / kEntryName, ignored);
  };
  const Result<std::vector<fs::path>> contents = folder_contents(folder);
  return contents && std::any_of(contents->begin(), contents->end(), is_complete_video);
}

std::string split_of(const PlannedVideo& video) {
  return video.split.empty() ? "all" : video.split;
}

std::vector<std::string> splits_of(const std::vector<FinishedVideo>& videos) {
  std::vector<std::string> splits;
  for (const FinishedVideo& one : videos)
    if (const std::string split = split_of(*one.video); std::find(splits.begin(), splits.end(), split) == splits.end())
      splits.push_back(split);
  return splits;
}

Result<DatasetIndex> make_index(const Plan& plan, const DatasetSource& source, const fs::path& dataset,
                                const std::vector<FinishedVideo>& videos, const std::atomic<bool>* cancel) {
  if (const Result<void> step = remove_index(dataset); !step) return fail(step.error());
  const Result<std::vector<DatasetFile>> shared = shared_files(plan, dataset, videos, cancel);
  if (!shared) {
    // All that was read lies in the dataset and was there when its videos were checked.
    Error error = shared.error();
    if (error.kind == ErrorKind::cannot_read) error.kind = ErrorKind::write_failed;
    return fail(error);
  }
  const std::string checksums = checksums_of(videos, *shared);
  Json index = index_of(plan, source, videos);
  index["shared_files"] = described(*shared, "");
  index["checksum"] = checksum_of_text(checksums);
  Result<void> step = check_shared_files(dataset);  // making them may have taken long
  if (step) step = write_dataset_file(dataset, kChecksumsName, checksums);
  if (step) step = flush(dataset);
  for (const char* const name : kSharedFolders)
    if (step) step = commit(dataset, name);
  if (step) step = write_dataset_file(dataset, kIndexName, json_text(index));
  if (step) step = flush(dataset);
  if (!step) return fail(step.error());
  DatasetIndex made{.written = {dataset / kIndexName, dataset / kChecksumsName}, .checksum = index["checksum"]};
  std::error_code code;
  for (const char* const name : kSharedFolders)
    if (fs::exists(dataset / name, code)) made.written.push_back(dataset / name);
  return made;
}

Result<Json> for_each_indexed_video(const fs::path& folder, const std::atomic<bool>* cancel,
                                    const std::function<Result<void>(const IndexedVideo&, pugi::xml_node)>& visit) {
  const fs::path file = folder / kIndexName;
  const Result<std::string> text = read_text(file);
  if (!text) return fail(text.error());
  Result<Json> index = parsed_json(*text, file.string(), ErrorKind::bad_data);
  if (!index) return index;
  Result<std::vector<IndexedVideo>> videos = videos_in_index(*index, file);
  if (!videos) return fail(videos.error());
  for (IndexedVideo& video : *videos) {
    if (const Result<void> on = check_interrupt(cancel); !on) return fail(on.error());
    const fs::path base = folder / video.name / video.name;
    const Result<pugi::xml_document> document = annotations_of(base.string() + ".xml");
    if (!document) return fail(document.error());
    video.categories = categories_of(base.string() + ".json");
    if (const Result<void> visited = visit(video, document->child("sigs")); !visited) return fail(visited.error());
  }
  return index;
}

double attribute_of(pugi::xml_node node, const char* name) {
  const std::optional<double> number = parsed_number(trimmed(node.attribute(name).value()));
  return number.value_or(std::nan(""));
}

}  // namespace sigs

// SPDX-License-Identifier: MIT
#include "mesh/model_files.h"

#include <algorithm>
#include <string>
#include <string_view>

#include "base/input_file.h"
#include "base/text.h"
#include "mesh/materials.h"

namespace sigs {

namespace fs = std::filesystem;

namespace {

// The files that the rest of a line may name. Options and other names may come first, so each word, and everything from
// each word on, is tried.
std::vector<fs::path> files_named(std::string_view rest, const fs::path& folder) {
  std::vector<fs::path> files;
  for (std::string_view end = trimmed(rest); !end.empty(); end = trimmed(end)) {
    const std::string_view whole = end;
    const std::string_view word = next_token(end);
    for (const std::string_view name : {whole, word})
      if (const fs::path file = found_file(folder, std::string(name)); !file.empty()) files.push_back(file);
  }
  return files;
}

bool names_texture(std::string_view key) {
  return key.starts_with("map_") || key == "bump" || key == "disp" || key == "decal" || key == "refl" || key == "norm";
}

// The files named in those lines of a text file whose first word is_asked_for() accepts.
template <class IsAskedFor>
Result<std::vector<fs::path>> files_named_in(const fs::path& file, const IsAskedFor& is_asked_for) {
  const Result<std::string> text = read_text(file);
  if (!text) return fail(text.error());
  std::vector<fs::path> files;
  std::string_view rest = *text;
  while (!rest.empty()) {
    std::string_view line = next_line(rest);
    if (!is_asked_for(next_token(line))) continue;
    const std::vector<fs::path> named = files_named(line, file.parent_path());
    files.insert(files.end(), named.begin(), named.end());
  }
  return files;
}

bool names_library(std::string_view key) {
  return key == "mtllib";
}

}  // namespace

Result<std::vector<fs::path>> files_of_model(const fs::path& file) {
  const Result<std::vector<fs::path>> libraries = files_named_in(file, names_library);
  if (!libraries) return fail(libraries.error());
  std::vector<fs::path> files{file};
  for (const fs::path& library : *libraries) {
    files.push_back(library);
    const Result<std::vector<fs::path>> images = files_named_in(library, names_texture);
    if (images) files.insert(files.end(), images->begin(), images->end());
  }
  return files;
}

namespace {

bool has_changed(const FileStamp& stamp) {
  return stamp_of(stamp.path) != stamp;
}

}  // namespace

const std::vector<FileStamp>& ModelStamps::of(const fs::path& file) {
  Listed& listed = listed_[file];
  if (!listed.files.empty() && std::ranges::none_of(listed.files, has_changed) &&
      std::ranges::none_of(listed.folders, has_changed))
    return listed.files;
  // Stamps come before the files are read, so that what is written meanwhile is a change.
  listed = {.files = {stamp_of(file)}, .folders = {stamp_of(file.parent_path())}};
  const Result<std::vector<fs::path>> others = files_of_model(file);
  if (!others) return listed.files;
  for (const fs::path& other : *others) {
    if (std::ranges::find(listed.files, other, &FileStamp::path) == listed.files.end())
      listed.files.push_back(stamp_of(other));
    if (std::ranges::find(listed.folders, other.parent_path(), &FileStamp::path) == listed.folders.end())
      listed.folders.push_back(stamp_of(other.parent_path()));
  }
  return listed.files;
}

}  // namespace sigs

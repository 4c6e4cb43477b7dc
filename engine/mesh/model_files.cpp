// SPDX-License-Identifier: MIT
#include "mesh/model_files.h"

#include <string>
#include <string_view>

#include "base/temporary_file.h"
#include "base/text_pieces.h"
#include "mesh/textures.h"

namespace sigs {

namespace fs = std::filesystem;

namespace {

// The files that the rest of a line may name: all of it, or, as options and other files may stand before, each end of
// it that begins with a word.
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

bool names_picture(std::string_view key) {
  return key.starts_with("map_") || key == "bump" || key == "disp" || key == "decal" || key == "refl" || key == "norm";
}

// Files that the lines of a text name whose key is asked for.
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
    const Result<std::vector<fs::path>> images = files_named_in(library, names_picture);
    if (images) files.insert(files.end(), images->begin(), images->end());
  }
  return files;
}

}  // namespace sigs

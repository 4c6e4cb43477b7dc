// SPDX-License-Identifier: MIT
#include "base/paths.h"

#include <fmt/format.h>
#include <sys/stat.h>

#include <algorithm>
#include <map>
#include <optional>
#include <string>
#include <system_error>
#include <utility>

#include "base/text.h"

namespace sigs {

namespace fs = std::filesystem;

namespace {

using Identity = std::pair<dev_t, ino_t>;

std::optional<Identity> identity_of(const fs::path& path) {
  struct stat state {};
  if (path.empty() || stat(path.c_str(), &state) != 0) return std::nullopt;
  return Identity(state.st_dev, state.st_ino);
}

bool is_there(const fs::path& path) {
  std::error_code code;
  return fs::exists(fs::symlink_status(path, code));
}

// The input that has a second name in the folder; none: nullptr.
const fs::path* named_in(const fs::path& folder, const std::map<Identity, const fs::path*>& inputs) {
  std::error_code code;
  for (fs::recursive_directory_iterator it(folder, code), end; !code && it != end; it.increment(code)) {
    const std::optional<Identity> identity = identity_of(it->path());
    if (!identity) continue;
    if (const auto input = inputs.find(*identity); input != inputs.end()) return input->second;
  }
  return nullptr;
}

Result<void> input_refused(const fs::path& output, const std::string& what, std::string_view reader) {
  return fail(output.string(), fmt::format("{}is read by this {}; choose another name", what, reader),
              ErrorKind::cannot_create);
}

std::string holding(const fs::path& input) {
  return fmt::format("holds {}, which ", input.string());
}

Result<void> check_kept(const fs::path& output, const std::vector<fs::path>& inputs,
                        const std::map<Identity, const fs::path*>& identities, std::string_view reader) {
  if (!is_there(output)) return {};
  const std::optional<Identity> identity = identity_of(output);
  if (identity && identities.contains(*identity)) {
    const fs::path& input = *identities.at(*identity);
    return input_refused(
        output, canonical_name(input) == canonical_name(output) ? "" : fmt::format("is {}, which ", input.string()),
        reader);
  }
  const fs::path name = canonical_name(output);
  const fs::path target = canonical_path(output);
  for (const fs::path& input : inputs) {
    if (input.empty() || !is_there(input)) continue;
    for (const fs::path& place : {canonical_name(input), canonical_path(input)})
      if (is_at_or_below(place, name) || is_at_or_below(place, target))
        return input_refused(output, holding(input), reader);
  }
  std::error_code code;
  if (!fs::is_directory(output, code)) return {};
  const fs::path* const input = named_in(output, identities);
  return input != nullptr ? input_refused(output, holding(*input), reader) : Result<void>();
}

}  // namespace

std::string file_name_error(const std::string& name) {
  constexpr std::size_t kMax = 200;  // bytes
  if (name.empty()) return "is empty; it becomes a file's name";
  if (name.size() > kMax) return "is longer than 200 bytes; it becomes a file's name";
  const bool is_plain = std::all_of(name.begin(), name.end(), [](char c) {
    return c != '/' && c != 0x7f && (c < 0 || static_cast<unsigned char>(c) >= 0x20);
  });
  if (name.front() == '.' || !is_plain)
    return "becomes a file's name: it may hold no / and no control character and not begin with a dot";
  return {};
}

std::string lower_extension(const fs::path& path) {
  return lower_case(path.extension().string());
}

Result<std::vector<fs::path>> folder_contents(const fs::path& folder) {
  std::vector<fs::path> paths;
  std::error_code code;
  for (fs::directory_iterator it(folder, code), end; !code && it != end; it.increment(code))
    paths.push_back(it->path());
  if (code) return fail(folder.string(), "cannot be looked through: " + code.message(), ErrorKind::cannot_read);
  std::sort(paths.begin(), paths.end());
  return paths;
}

bool is_folder(const fs::path& path) {
  std::error_code code;
  return fs::is_directory(path, code);
}

bool is_at_or_below(const fs::path& path, const fs::path& folder) {
  return std::mismatch(folder.begin(), folder.end(), path.begin(), path.end()).first == folder.end();
}

fs::path canonical_path(const fs::path& path) {
  std::error_code code;
  const fs::path place = fs::weakly_canonical(fs::absolute(path, code), code);
  const fs::path plain = code ? fs::absolute(path, code).lexically_normal() : place;
  return plain.has_filename() ? plain : plain.parent_path();
}

fs::path canonical_name(const fs::path& path) {
  std::error_code code;
  const fs::path absolute = fs::absolute(path, code);
  return absolute.has_filename() ? canonical_path(absolute.parent_path()) / absolute.filename()
                                 : canonical_path(absolute);
}

Result<void> check_inputs_not_overwritten(const std::vector<fs::path>& outputs, const std::vector<fs::path>& inputs,
                                          std::string_view reader) {
  std::map<Identity, const fs::path*> identities;
  for (const fs::path& input : inputs)
    if (const std::optional<Identity> identity = identity_of(input)) identities.emplace(*identity, &input);
  for (const fs::path& output : outputs)
    if (const Result<void> kept = check_kept(output, inputs, identities, reader); !kept) return kept;
  return {};
}

}  // namespace sigs

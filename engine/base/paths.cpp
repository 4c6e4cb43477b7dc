// SPDX-License-Identifier: MIT
#include "base/paths.h"

#include <fmt/format.h>

#include <dirent.h>
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>
#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <map>
#include <memory>
#include <new>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "base/file_lock.h"
#include "base/text.h"

namespace sigs {

namespace fs = std::filesystem;

namespace {

struct Closing {
  void operator()(DIR* folder) const { closedir(folder); }
};

// Why errno says that a folder could not be looked through. Throws std::bad_alloc where memory is why.
Error not_looked_through(const fs::path& folder) {
  if (errno == ENOMEM) throw std::bad_alloc();
  return {folder.string(), std::string("cannot be looked through: ") + std::strerror(errno), ErrorKind::cannot_read};
}

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
  const std::unique_ptr<DIR, Closing> entries(opendir(folder.c_str()));
  if (entries == nullptr) return fail(not_looked_through(folder));
  std::vector<fs::path> paths;
  for (;;) {
    errno = 0;
    const dirent* const entry = readdir(entries.get());
    if (entry == nullptr) break;
    const std::string_view name = entry->d_name;
    if (name != "." && name != "..") paths.push_back(folder / name);
  }
  if (errno != 0) return fail(not_looked_through(folder));
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

namespace {

std::error_code code_of(int result) {
  return result == 0 ? std::error_code() : std::error_code(errno, std::generic_category());
}

// The errors of file systems without the flag, and of kernels without the call.
bool is_unknown_here(const std::error_code& code) {
  return code == std::errc::invalid_argument || code == std::errc::function_not_supported ||
         code == std::errc::operation_not_supported;
}

std::error_code renamed(const fs::path& from, const fs::path& to, unsigned int flags) {
  return code_of(renameat2(AT_FDCWD, from.c_str(), AT_FDCWD, to.c_str(), flags));
}

bool is_real_folder(const fs::path& path) {
  std::error_code code;
  return fs::symlink_status(path, code).type() == fs::file_type::directory;
}

std::error_code back_up_and_replace(const fs::path& from, const fs::path& to, const fs::path& backup) {
  if (const std::error_code code = rename_new(to, backup); code) return code;
  const std::error_code code = rename_new(from, to);
  if (!code) return {};
  return rename_new(backup, to) ? std::make_error_code(std::errc::state_not_recoverable) : code;
}

}  // namespace

std::error_code rename_new(const fs::path& from, const fs::path& to) {
  const std::error_code code = renamed(from, to, RENAME_NOREPLACE);
  if (!is_unknown_here(code)) return code;
  struct stat there {};
  if (lstat(to.c_str(), &there) == 0) return std::make_error_code(std::errc::file_exists);
  if (!is_real_folder(from)) {
    const std::error_code linked = code_of(link(from.c_str(), to.c_str()));
    if (linked == std::errc::file_exists) return linked;
    if (!linked) return code_of(unlink(from.c_str()));
  }
  return code_of(rename(from.c_str(), to.c_str()));  // a folder: refused where one with something in it has the name
}

std::error_code replace_with_backup(const fs::path& from, const fs::path& to, const fs::path& backup) {
  const std::error_code code = renamed(from, to, RENAME_EXCHANGE);
  if (!code) {
    const std::error_code moved = rename_new(from, backup);
    return moved && renamed(from, to, RENAME_EXCHANGE) ? std::make_error_code(std::errc::state_not_recoverable) : moved;
  }
  if (!is_unknown_here(code)) return code;
  const bool are_files = !is_real_folder(from) && !is_real_folder(to);
  if (!are_files || link(to.c_str(), backup.c_str()) != 0) return back_up_and_replace(from, to, backup);
  const std::error_code replaced = code_of(rename(from.c_str(), to.c_str()));  // the older file has a second name
  if (replaced) unlink(backup.c_str());
  return replaced;
}

Result<void> flush(const fs::path& file) {
  const Descriptor descriptor(open(file.c_str(), O_RDONLY | O_CLOEXEC));
  if (!descriptor.is_open() && errno == EACCES) return {};  // a folder that may be written into but not listed
  if (!descriptor.is_open())
    return fail(file.string(), std::string("cannot be read: ") + std::strerror(errno), ErrorKind::write_failed);
  const bool lost = fsync(descriptor.number()) != 0 && (errno == EIO || errno == ENOSPC || errno == EDQUOT);
  const std::string why = std::strerror(errno);
  if (lost) return fail(file.string(), "could not be written: " + why, ErrorKind::write_failed);
  return {};
}

Result<void> flush_all(const fs::path& folder) {
  const Result<std::vector<fs::path>> paths = folder_contents(folder);
  if (!paths) return fail(folder.string(), paths.error().what, ErrorKind::write_failed);
  for (const fs::path& path : *paths) {
    std::error_code code;
    const fs::file_type type = fs::symlink_status(path, code).type();
    Result<void> step;
    if (type == fs::file_type::directory) step = flush_all(path);
    if (type == fs::file_type::regular) step = flush(path);
    if (!step) return step;
  }
  return flush(folder);
}

}  // namespace sigs

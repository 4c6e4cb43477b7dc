// SPDX-License-Identifier: MIT
#include "base/input_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <linux/magic.h>
#include <sys/stat.h>
#include <sys/statfs.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstddef>
#include <cstring>

#include "base/file_lock.h"

namespace sigs {

namespace fs = std::filesystem;

namespace {

constexpr std::size_t kPiece_bytes = 64 << 10;  // by which the text grows beyond the size that the file system reports

tl::unexpected<Error> cannot_read(const fs::path& path, int error) {
  if (error == ENOENT || error == ENOTDIR) return fail(path.string(), "no such file", ErrorKind::cannot_read);
  return fail(path.string(), std::string("cannot be read: ") + std::strerror(error), ErrorKind::cannot_read);
}

const char* name_of(mode_t mode) {
  if (S_ISCHR(mode) || S_ISBLK(mode)) return "device";
  if (S_ISFIFO(mode)) return "pipe (FIFO)";
  if (S_ISSOCK(mode)) return "socket";
  return "special file";
}

// "a video", "an image".
std::string with_article(const std::string& thing) {
  return (std::string_view("aeiou").find(thing.front()) == std::string_view::npos ? "a " : "an ") + thing;
}

Result<void> check_mode(const fs::path& path, mode_t mode, const std::string& thing) {
  if (S_ISREG(mode)) return {};
  if (S_ISDIR(mode)) return fail(path.string(), "is a folder, not " + with_article(thing), ErrorKind::cannot_read);
  return fail(path.string(),
              fmt::format("is a {}, not {}; a regular file is needed", name_of(mode), with_article(thing)),
              ErrorKind::cannot_read);
}

// Files of /proc, /sys and the like are regular ones by their mode, and some of them never end (/proc/kmsg).
Result<void> check_file_system(const fs::path& path, const struct statfs& found, const std::string& thing) {
  for (const long kernels : {PROC_SUPER_MAGIC, SYSFS_MAGIC, DEBUGFS_MAGIC, TRACEFS_MAGIC})
    if (found.f_type == kernels)
      return fail(path.string(), fmt::format("is a file of the kernel's (/proc, /sys), not {}", with_article(thing)),
                  ErrorKind::cannot_read);
  return {};
}

tl::unexpected<Error> too_large(const fs::path& path, std::uint64_t limit_bytes) {
  return fail(path.string(),
              fmt::format("is larger than {} MiB, the most that is read of such a file", limit_bytes / kMebibyte));
}

}  // namespace

Result<void> check_input_file(const fs::path& path, const std::string& thing) {
  struct stat found {};
  if (stat(path.c_str(), &found) != 0) return cannot_read(path, errno);
  if (const Result<void> regular = check_mode(path, found.st_mode, thing); !regular) return regular;
  struct statfs system {};
  if (statfs(path.c_str(), &system) != 0) return cannot_read(path, errno);
  return check_file_system(path, system, thing);
}

Result<std::string> read_text(const fs::path& path, std::uint64_t limit_bytes) {
  if (const Result<void> file = check_input_file(path); !file) return fail(file.error());
  // A pipe may have taken its place meanwhile: opening it does not wait for a writer.
  const Descriptor file(open(path.c_str(), O_RDONLY | O_NONBLOCK | O_NOCTTY | O_CLOEXEC));
  struct stat found {};
  if (!file.is_open() || fstat(file.number(), &found) != 0) return cannot_read(path, errno);
  if (const Result<void> regular = check_mode(path, found.st_mode, "file"); !regular) return fail(regular.error());
  struct statfs system {};
  if (fstatfs(file.number(), &system) != 0) return cannot_read(path, errno);
  if (const Result<void> usual = check_file_system(path, system, "file"); !usual) return fail(usual.error());
  if (static_cast<std::uint64_t>(found.st_size) > limit_bytes) return too_large(path, limit_bytes);
  std::string text;
  text.resize(static_cast<std::size_t>(found.st_size) + 1);  // the last read shows that there is no more
  for (std::size_t filled = 0;;) {
    const ssize_t got = read(file.number(), text.data() + filled, text.size() - filled);
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) return cannot_read(path, errno);
    filled += static_cast<std::size_t>(got);
    if (filled > limit_bytes) return too_large(path, limit_bytes);
    if (got == 0) {
      text.resize(filled);
      return text;
    }
    if (filled == text.size()) text.resize(filled + std::max(filled / 2, kPiece_bytes));  // it grows
  }
}

int json_depth(std::string_view text) {
  int depth = 0;
  int deepest = 0;
  bool is_quoted = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (c == '"') is_quoted = !is_quoted;
    if (is_quoted && c == '\\') ++i;
    if (is_quoted) continue;
    if (c == '[' || c == '{') deepest = std::max(deepest, ++depth);
    if (c == ']' || c == '}') --depth;
  }
  return deepest;
}

int xml_depth(std::string_view text) {
  int depth = 0;
  int deepest = 0;
  for (std::size_t at = text.find('<'); at != std::string_view::npos; at = text.find('<', at)) {
    const std::string_view tag = text.substr(at);
    const bool is_comment = tag.starts_with("<!--");
    const std::size_t end = is_comment ? tag.find("-->", 4) : tag.find('>');
    const bool is_element = !tag.starts_with("<!") && !tag.starts_with("<?") && !tag.starts_with("</");
    if (tag.starts_with("</")) --depth;
    if (is_element) deepest = std::max(deepest, ++depth);
    if (end == std::string_view::npos) break;
    if (is_element && tag[end - 1] == '/') --depth;
    at += end;
  }
  return deepest;
}

}  // namespace sigs

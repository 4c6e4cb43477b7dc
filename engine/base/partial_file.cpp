// SPDX-License-Identifier: MIT
#include "base/partial_file.h"

#include <cerrno>
#include <cstring>
#include <fstream>
#include <sstream>
#include <system_error>
#include <utility>

namespace sigs {

namespace fs = std::filesystem;

Result<PartialFile> PartialFile::create(fs::path final_path, bool overwrite) {
  std::error_code code;
  if (!overwrite && fs::exists(final_path, code))
    return fail(final_path.string(), "exists already; --force overwrites it", ErrorKind::cannot_create);
  const fs::path folder = final_path.has_parent_path() ? final_path.parent_path() : fs::path(".");
  if (!fs::is_directory(folder, code))
    return fail(folder.string(), "no such folder to write into", ErrorKind::cannot_create);
  fs::path part = final_path;
  part.replace_filename(final_path.stem().string() + ".part" + final_path.extension().string());
  return PartialFile(std::move(final_path), std::move(part));
}

PartialFile::PartialFile(fs::path final_path, fs::path part) : final_(std::move(final_path)), part_(std::move(part)) {}

PartialFile::PartialFile(PartialFile&& other) noexcept
    : final_(std::move(other.final_)), part_(std::exchange(other.part_, {})) {}

PartialFile& PartialFile::operator=(PartialFile&& other) noexcept {
  if (this == &other) return *this;
  discard();
  final_ = std::move(other.final_);
  part_ = std::exchange(other.part_, {});
  return *this;
}

PartialFile::~PartialFile() {
  discard();
}

void PartialFile::discard() noexcept {
  std::error_code code;
  if (!part_.empty()) fs::remove_all(part_, code);
}

Result<void> PartialFile::keep() {
  std::error_code code;
  if (fs::is_directory(part_, code)) fs::remove_all(final_, code);
  fs::rename(part_, final_, code);
  if (code) return fail(final_.string(), "cannot be given its final name: " + code.message(), ErrorKind::write_failed);
  part_.clear();
  return {};
}

Result<std::string> read_text(const fs::path& path) {
  std::error_code code;
  if (!fs::exists(path, code)) return fail(path.string(), "no such file", ErrorKind::cannot_read);
  if (fs::is_directory(path, code)) return fail(path.string(), "is a folder, not a file", ErrorKind::cannot_read);
  std::ifstream in(path, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  if (!in) return fail(path.string(), std::string("cannot be read: ") + std::strerror(errno), ErrorKind::cannot_read);
  return text.str();
}

Result<void> write_text(const fs::path& path, std::string_view text, bool overwrite) {
  Result<PartialFile> file = PartialFile::create(path, overwrite);
  if (!file) return fail(file.error());
  std::ofstream out(file->part(), std::ios::binary);
  if (!out)
    return fail(path.string(), std::string("cannot be created: ") + std::strerror(errno), ErrorKind::cannot_create);
  out.write(text.data(), static_cast<std::streamsize>(text.size()));
  out.close();
  if (!out)
    return fail(path.string(), std::string("could not be written: ") + std::strerror(errno), ErrorKind::write_failed);
  return file->keep();
}

}  // namespace sigs

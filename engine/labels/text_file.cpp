// SPDX-License-Identifier: MIT
#include "labels/text_file.h"

#include <cerrno>
#include <cstring>
#include <string>
#include <system_error>
#include <utility>

namespace sigs {

namespace fs = std::filesystem;

TextFile::TextFile(fs::path path, std::ofstream out) : path_(std::move(path)), out_(std::move(out)) {}

Result<TextFile> TextFile::create(fs::path path) {
  std::ofstream out(path, std::ios::binary);
  if (!out)
    return fail(path.string(), std::string("cannot be created: ") + std::strerror(errno), ErrorKind::cannot_create);
  return TextFile(std::move(path), std::move(out));
}

Result<void> TextFile::put(std::string_view text) {
  out_.write(text.data(), static_cast<std::streamsize>(text.size()));
  if (!out_)
    return fail(path_.string(), std::string("could not be written: ") + std::strerror(errno), ErrorKind::write_failed);
  return {};
}

Result<void> TextFile::close() {
  out_.close();
  if (!out_) return fail(path_.string(), "could not be written to its end", ErrorKind::write_failed);
  return {};
}

Result<void> write_text_file(const fs::path& path, std::string_view text) {
  Result<TextFile> file = TextFile::create(path);
  if (!file) return fail(file.error());
  if (const Result<void> put = file->put(text); !put) return put;
  return file->close();
}

Result<void> make_inner_folder(const fs::path& folder) {
  std::error_code code;
  fs::create_directories(folder, code);
  if (code) return fail(folder.string(), "cannot be created: " + code.message(), ErrorKind::cannot_create);
  return {};
}

}  // namespace sigs

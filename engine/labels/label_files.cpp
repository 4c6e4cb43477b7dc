// SPDX-License-Identifier: MIT
#include "labels/label_files.h"

#include <fmt/format.h>

#include <cerrno>
#include <cstring>
#include <string>
#include <system_error>
#include <utility>

#include "labels/labels.h"

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

Result<void> link_or_copy(const fs::path& from, const fs::path& to) {
  std::error_code code;
  fs::create_hard_link(from, to, code);
  if (!code) return {};
  // Another file system, one without hard links, or too many names for one file. Any other cause makes the copy fail
  // too.
  fs::copy_file(from, to, fs::copy_options::none, code);
  if (code)
    return fail(to.string(), fmt::format("could not be made of {}: {}", from.string(), code.message()),
                ErrorKind::write_failed);
  return {};
}

Result<void> link_numbered_images(const fs::path& images, const FootageTruth& footage, const fs::path& folder,
                                  ImageNumbers numbers) {
  if (images.empty()) return {};
  if (const Result<void> created = make_inner_folder(folder); !created) return created;
  for (int frame = footage.first_frame; frame <= footage.last_frame; ++frame) {
    const int number = frame - footage.first_frame + numbers.first;
    const fs::path name = folder / fmt::format("{:0{}}{}", number, numbers.digits, numbers.extension);
    if (const Result<void> linked = link_or_copy(images / image_name(frame, numbers.extension), name); !linked)
      return linked;
  }
  return {};
}

}  // namespace sigs

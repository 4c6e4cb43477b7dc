// SPDX-License-Identifier: MIT
#include "cli/output_files.h"

#include <cerrno>
#include <cstring>
#include <fstream>
#include <string>
#include <system_error>

#include "base/image_codecs.h"

namespace sigs::cli {

namespace fs = std::filesystem;

Result<void> write_bytes(const fs::path& staged, std::string_view bytes) {
  std::ofstream out(staged, std::ios::binary);
  out.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  out.close();
  if (out) return {};
  return fail(staged.string(), std::string("could not be written: ") + std::strerror(errno), ErrorKind::write_failed);
}

Result<void> write_png(const fs::path& staged, const cv::Mat& image) {
  std::vector<uchar> bytes;
  image_codecs::imencode(".png", image, bytes);
  return write_bytes(staged, {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
}

CreatedFolders::~CreatedFolders() {
  std::error_code code;
  for (auto last = created_.rbegin(); last != created_.rend(); ++last)
    fs::remove(*last, code);  // refused where not empty
}

Result<void> CreatedFolders::make(const fs::path& folder) {
  fs::path part;
  for (const fs::path& name : folder) {
    part /= name;
    std::error_code code;
    if (fs::create_directory(part, code)) created_.push_back(fs::absolute(part, code));
    if (code) return fail(folder.string(), "cannot be created: " + code.message(), ErrorKind::cannot_create);
  }
  return {};
}

Result<void> ImageFiles::reserve(const fs::path& path) {
  const Result<fs::path> staged = outputs_.add_file(path);
  if (!staged) return fail(staged.error());
  staged_[path] = *staged;
  return {};
}

Result<void> ImageFiles::write(const fs::path& path, const cv::Mat& image) {
  if (!staged_.contains(path))
    if (const Result<void> reserved = reserve(path); !reserved) return reserved;
  if (const Result<void> written = write_png(staged_[path], image); !written)
    return fail(outputs_.with_final_names(written.error()));
  return {};
}

Result<std::vector<fs::path>> ImageFiles::commit() {
  if (const Result<void> kept = outputs_.commit(); !kept) return fail(kept.error());
  return outputs_.final_paths();
}

}  // namespace sigs::cli

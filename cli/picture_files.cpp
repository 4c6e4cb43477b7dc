// SPDX-License-Identifier: MIT
#include "cli/picture_files.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <opencv2/imgcodecs.hpp>
#include <string>
#include <utility>

namespace sigs::cli {

namespace fs = std::filesystem;

const PartialFile* PictureFiles::taken(const fs::path& path) const {
  const auto file = std::find_if(files_.begin(), files_.end(),
                                 [&path](const PartialFile& held) { return held.final_path() == path; });
  return file == files_.end() ? nullptr : &*file;
}

Result<void> PictureFiles::reserve(const fs::path& path) {
  Result<PartialFile> file = PartialFile::create(path, overwrite_);
  if (!file) return fail(file.error());
  files_.push_back(std::move(*file));
  return {};
}

Result<void> PictureFiles::write(const fs::path& path, const cv::Mat& picture) {
  if (taken(path) == nullptr)
    if (const Result<void> reserved = reserve(path); !reserved) return reserved;
  std::vector<uchar> bytes;
  cv::imencode(".png", picture, bytes);
  std::ofstream out(taken(path)->part(), std::ios::binary);
  out.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  out.close();
  if (!out)
    return fail(path.string(), std::string("could not be written: ") + std::strerror(errno), ErrorKind::write_failed);
  return {};
}

Result<std::vector<fs::path>> PictureFiles::keep() {
  std::vector<fs::path> written;
  for (PartialFile& file : files_) {
    if (const Result<void> step = file.keep(); !step) return fail(step.error());
    written.push_back(file.final_path());
  }
  return written;
}

}  // namespace sigs::cli

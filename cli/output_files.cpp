// SPDX-License-Identifier: MIT
#include "cli/output_files.h"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <string>

#include "base/image_codecs.h"
#include "base/paths.h"

namespace sigs::cli {

namespace fs = std::filesystem;

Result<void> check_outputs(const std::vector<CommandOutput>& outputs, const std::vector<fs::path>& inputs) {
  for (std::size_t i = 0; i < outputs.size(); ++i) {
    const auto& [option, path] = outputs[i];
    if (path.empty()) continue;
    const std::string where = std::string(option) + " " + path.string();
    if (option == std::string_view("--plot"))
      if (const Result<void> named = check_png_output(option, path, {}); !named) return named;
    for (std::size_t j = 0; j < i; ++j)
      if (!outputs[j].path.empty() && canonical_name(path) == canonical_name(outputs[j].path))
        return fail(where, std::string("is where ") + outputs[j].option + " goes", ErrorKind::usage);
    if (const Result<void> kept = check_inputs_not_overwritten(std::vector{path}, inputs); !kept)
      return fail(where, kept.error().what, ErrorKind::cannot_create);
  }
  return {};
}

Result<void> check_png_output(const std::string& option, const fs::path& path, const std::vector<fs::path>& inputs) {
  const std::string where = option + " " + path.string();
  if (lower_extension(path) != ".png") return fail(where, "is written as PNG; end its name in .png", ErrorKind::usage);
  if (const Result<void> kept = check_inputs_not_overwritten(std::vector{path}, inputs); !kept)
    return fail(where, kept.error().what, ErrorKind::cannot_create);
  return {};
}

std::string png_bytes(const cv::Mat& image) {
  std::vector<uchar> bytes;
  image_codecs::imencode(".png", image, bytes);
  return {bytes.begin(), bytes.end()};
}

Result<void> OutputFiles::reserve(const fs::path& path) {
  const Result<fs::path> staged = outputs_.add_file(path);
  if (!staged) return fail(staged.error());
  staged_[path] = *staged;
  return {};
}

Result<void> OutputFiles::reserve(const std::vector<CommandOutput>& outputs) {
  for (const CommandOutput& output : outputs)
    if (!output.path.empty())
      if (const Result<void> reserved = reserve(output.path); !reserved) return reserved;
  return {};
}

Result<void> OutputFiles::write(const fs::path& path, std::string_view bytes) {
  if (!staged_.contains(path))
    if (const Result<void> reserved = reserve(path); !reserved) return reserved;
  std::ofstream out(staged_[path], std::ios::binary);
  out.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  out.close();
  if (out) return {};
  return fail(with_final_names(
      {staged_[path].string(), std::string("could not be written: ") + std::strerror(errno), ErrorKind::write_failed}));
}

Result<void> OutputFiles::write(const fs::path& path, const cv::Mat& image) {
  return write(path, png_bytes(image));
}

Result<void> OutputFiles::write_and_commit(const std::vector<OutputBytes>& outputs) {
  for (const auto& [path, bytes_of] : outputs) {
    if (path.empty()) continue;
    const Result<std::string> bytes = bytes_of();
    if (!bytes) return fail(bytes.error());
    if (const Result<void> written = write(path, std::string_view(*bytes)); !written) return written;
  }
  return commit();
}

void print_written(const std::vector<fs::path>& paths) {
  for (const fs::path& path : paths) std::printf("%s\n", path.c_str());
}

}  // namespace sigs::cli

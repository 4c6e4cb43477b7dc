// SPDX-License-Identifier: MIT
#include "base/temporary_file.h"

#include <cerrno>
#include <cstring>
#include <fstream>
#include <system_error>
#include <utility>

namespace sigs {

namespace fs = std::filesystem;

namespace {

StagedOutputs::Existing existing(bool overwrite) {
  return overwrite ? StagedOutputs::Existing::replace : StagedOutputs::Existing::refuse;
}

}  // namespace

Result<TemporaryFile> TemporaryFile::create(fs::path final_path, bool overwrite) {
  StagedOutputs outputs(existing(overwrite));
  Result<fs::path> temporary_path = outputs.add_file(final_path);
  if (!temporary_path) return fail(temporary_path.error());
  return TemporaryFile(std::move(final_path), std::move(*temporary_path), std::move(outputs));
}

Result<TemporaryFile> TemporaryFile::create_folder(fs::path final_path, bool overwrite,
                                                   StagedOutputs::MayReplace may_replace) {
  StagedOutputs outputs(existing(overwrite));
  Result<fs::path> temporary_path = outputs.add_folder(final_path, std::move(may_replace));
  if (!temporary_path) return fail(temporary_path.error());
  return TemporaryFile(std::move(final_path), std::move(*temporary_path), std::move(outputs));
}

TemporaryFile::TemporaryFile(fs::path final_path, fs::path temporary_path, StagedOutputs outputs)
    : final_(std::move(final_path)), temporary_path_(std::move(temporary_path)), outputs_(std::move(outputs)) {}

Result<void> write_text(const fs::path& path, std::string_view text, bool overwrite) {
  Result<TemporaryFile> file = TemporaryFile::create(path, overwrite);
  if (!file) return fail(file.error());
  std::ofstream out(file->temporary_path(), std::ios::binary);
  if (!out)
    return fail(path.string(), std::string("cannot be created: ") + std::strerror(errno), ErrorKind::cannot_create);
  out.write(text.data(), static_cast<std::streamsize>(text.size()));
  out.close();
  if (!out)
    return fail(path.string(), std::string("could not be written: ") + std::strerror(errno), ErrorKind::write_failed);
  return file->commit();
}

}  // namespace sigs

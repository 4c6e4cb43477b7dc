// SPDX-License-Identifier: MIT
#include "base/partial_file.h"

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

Result<PartialFile> PartialFile::create(fs::path final_path, bool overwrite) {
  StagedOutputs outputs(existing(overwrite));
  Result<fs::path> part = outputs.add_file(final_path);
  if (!part) return fail(part.error());
  return PartialFile(std::move(final_path), std::move(*part), std::move(outputs));
}

Result<PartialFile> PartialFile::create_folder(fs::path final_path, bool overwrite, StagedOutputs::MayGo may_go) {
  StagedOutputs outputs(existing(overwrite));
  Result<fs::path> part = outputs.add_folder(final_path, std::move(may_go));
  if (!part) return fail(part.error());
  return PartialFile(std::move(final_path), std::move(*part), std::move(outputs));
}

PartialFile::PartialFile(fs::path final_path, fs::path part, StagedOutputs outputs)
    : final_(std::move(final_path)), part_(std::move(part)), outputs_(std::move(outputs)) {}

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

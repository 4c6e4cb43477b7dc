// SPDX-License-Identifier: MIT
#include "dataset/checksum.h"

#include <fmt/format.h>

#include <array>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <vector>

extern "C" {
#include <libavutil/mem.h>
#include <libavutil/sha.h>
}

#include "base/ensure.h"
#include "base/input_file.h"
#include "base/interrupt.h"
#include "mesh/materials.h"
#include "project/fields.h"
#include "project/json.h"
#include "video/image_sequence.h"

namespace sigs {

namespace fs = std::filesystem;

namespace {

constexpr int kBits = 256;
constexpr std::size_t kPieceBytes = 1 << 20;

}  // namespace

struct Checksum::State {
  AVSHA* sha = av_sha_alloc();

  State() {
    ENSURE(sha != nullptr);
    av_sha_init(sha, kBits);
  }
  ~State() { av_free(sha); }
  State(const State&) = delete;
  State& operator=(const State&) = delete;
};

Checksum::Checksum() : state_(std::make_unique<State>()) {}
Checksum::Checksum(Checksum&&) noexcept = default;
Checksum& Checksum::operator=(Checksum&&) noexcept = default;
Checksum::~Checksum() = default;

void Checksum::add(std::string_view bytes) {
  av_sha_update(state_->sha, reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size());
}

std::string Checksum::text() {
  std::array<std::uint8_t, kBits / 8> digest{};
  av_sha_final(state_->sha, digest.data());
  std::string text;
  for (const std::uint8_t byte : digest)
    for (const int nibble : {byte >> 4, byte & 15}) text += "0123456789abcdef"[nibble];
  return text;
}

std::string checksum_of_text(std::string_view text) {
  Checksum checksum;
  checksum.add(text);
  return checksum.text();
}

Result<std::string> checksum_of_file(const fs::path& file, const std::atomic<bool>* cancel) {
  if (const Result<void> there = check_input_file(file); !there) return fail(there.error());
  std::ifstream in(file, std::ios::binary);
  if (!in) return fail(file.string(), std::string("cannot be read: ") + std::strerror(errno), ErrorKind::cannot_read);
  Checksum checksum;
  std::vector<char> piece(kPieceBytes);
  while (in) {
    if (const Result<void> on = check_interrupt(cancel); !on) return fail(on.error());
    in.read(piece.data(), static_cast<std::streamsize>(piece.size()));
    checksum.add({piece.data(), static_cast<std::size_t>(in.gcount())});
  }
  if (in.bad()) return fail(file.string(), "cannot be read to its end", ErrorKind::cannot_read);
  return checksum.text();
}

std::string checksum_line(const std::string& checksum, const std::string& path) {
  std::string name;
  for (const char c : path) {
    if (c == '\\')
      name += "\\\\";
    else if (c == '\n')
      name += "\\n";
    else if (c == '\r')
      name += "\\r";
    else
      name += c;
  }
  return fmt::format("{}{}  {}\n", name == path ? "" : "\\", checksum, name);
}

Result<std::string> InputChecksums::of(const fs::path& file) {
  const std::lock_guard lock(mutex_);
  if (const auto known = files_.find(file); known != files_.end()) return known->second;
  return files_.emplace(file, checksum_of_file(file, cancel_)).first->second;
}

Result<std::string> InputChecksums::of_model(const fs::path& file) {
  {
    const std::lock_guard lock(mutex_);
    if (const auto known = models_.find(file); known != models_.end()) return known->second;
  }
  const Result<std::vector<fs::path>> files = files_of_model(file);
  if (!files) return fail(files.error());
  std::string list;
  for (const fs::path& one : *files) {
    const Result<std::string> checksum = of(one);
    if (!checksum) return checksum;
    list += checksum_line(*checksum, one.filename().string());
  }
  const std::lock_guard lock(mutex_);
  return models_.emplace(file, checksum_of_text(list)).first->second;
}

Result<std::string> InputChecksums::of_images(const fs::path& sequence) {
  const Result<std::vector<fs::path>> files = files_of_sequence(sequence);
  if (!files) return fail(files.error());
  std::string list;
  for (const fs::path& one : *files) {
    const Result<std::string> checksum = of(one);
    if (!checksum) return checksum;
    list += checksum_line(*checksum, one.filename().string());
  }
  return checksum_of_text(list);
}

Result<std::string> fingerprint_of(const Project& project, const std::string& program, InputChecksums& inputs) {
  Project pathless = project;
  std::string list;
  for (const Field& field : fields_of(pathless)) {
    if (!field.is_path) continue;
    std::string& written = *std::get<std::string*>(field.value);
    if (written.empty()) continue;
    const fs::path file = resolved(project, written);
    std::error_code code;
    if (field.key == "footage.video" && is_image_sequence(file)) {
      const Result<std::string> checksum = inputs.of_images(file);
      if (!checksum) return fail(checksum.error());
      list += checksum_line(*checksum, field.key);
    } else if (fs::is_regular_file(file, code)) {
      const Result<std::string> checksum = field.key.ends_with("model.file") ? inputs.of_model(file) : inputs.of(file);
      if (!checksum) return fail(checksum.error());
      list += checksum_line(*checksum, field.key);
    }
    written = file.filename().string();
  }
  return checksum_of_text(fmt::format("{}\n{}{}", program, list, text_of(pathless)));
}

}  // namespace sigs

// SPDX-License-Identifier: MIT
#include "telemetry/gopro_header.h"

#include <cstdint>
#include <fstream>
#include <string_view>
#include <system_error>

#include "base/input_file.h"
#include "base/pose.h"
#include "base/text.h"
#include "telemetry/binary_numbers.h"
#include "telemetry/gpmf.h"

namespace sigs {

namespace {

constexpr std::uint64_t kMaxHeader_bytes = kMebibyte;
constexpr int kMaxBoxes = 10'000;  // of one level; a file has some ten, a broken one may have millions
constexpr int kMaxGpmfDepth = 8;

// A part of the file, in bytes from its beginning.
struct FilePart {
  std::uint64_t begin = 0;
  std::uint64_t end = 0;
};

std::string bytes_at(std::ifstream& in, std::uint64_t offset, std::size_t count) {
  std::string bytes(count, '\0');
  in.clear();
  in.seekg(static_cast<std::streamoff>(offset));
  in.read(bytes.data(), static_cast<std::streamsize>(count));
  bytes.resize(static_cast<std::size_t>(std::max<std::streamsize>(in.gcount(), 0)));
  return bytes;
}

// The contents of the first box of this type (ISO/IEC 14496-12, 4.2) in a part of the file.
std::optional<FilePart> box_in(std::ifstream& in, const FilePart& part, std::string_view type) {
  std::uint64_t at = part.begin;
  for (int i = 0; i < kMaxBoxes && part.end - at >= 8; ++i) {
    const std::string head = bytes_at(in, at, 16);
    if (head.size() < 8) return std::nullopt;
    std::uint64_t size = big_endian(std::string_view(head).substr(0, 4));
    std::uint64_t header = 8;
    if (size == 1 && head.size() == 16) size = big_endian(std::string_view(head).substr(8, 8)), header = 16;
    if (size == 0) size = part.end - at;
    if (size < header || size > part.end - at) return std::nullopt;
    if (std::string_view(head).substr(4, 4) == type) return FilePart{at + header, at + size};
    at += size;
  }
  return std::nullopt;
}

void take(const GpmfElement& element, GoproHeader& header) {
  const std::string text = element.type == 'c' ? gpmf_text(element) : std::string();
  if (element.key == "ZFOV") {
    const std::optional<GpmfNumbers> fov_deg = gpmf_numbers(element);
    if (fov_deg && fov_deg->rows() > 0 && fov_deg->at(0, 0) > 1 && fov_deg->at(0, 0) < 360)
      header.diagonal_fov_deg = fov_deg->at(0, 0);
  } else if (element.key == "VFOV" && !text.empty()) {
    header.fov_letter = text.front();
  } else if (element.key == "EISE") {
    header.is_stabilised = text.starts_with('Y');
  } else if (element.key == "EISA" && text != "N/A" && text != "N") {
    header.stabilisation = text;
  }
}

void take_all(std::string_view value, int depth, GoproHeader& header) {
  for (const GpmfElement& element : gpmf_level(value).elements) {
    if (element.type != 0)
      take(element, header);
    else if (depth < kMaxGpmfDepth)
      take_all(element.value, depth + 1, header);
  }
}

}  // namespace

std::optional<LoggedLens> GoproHeader::lens() const {
  if (!diagonal_fov_deg) return std::nullopt;
  const bool is_fisheye = fov_letter != 'L';
  return LoggedLens{.source = "GPMF ZFOV, " + number_text(*diagonal_fov_deg, 1) + " degrees across the diagonal",
                    .diagonal_fov_rad = rad_of_deg(*diagonal_fov_deg),
                    .is_fisheye = is_fisheye};
}

std::optional<GoproHeader> read_gopro_header(const std::filesystem::path& file) {
  if (!check_input_file(file)) return std::nullopt;
  std::error_code code;
  const std::uint64_t size = std::filesystem::file_size(file, code);
  std::ifstream in(file, std::ios::binary);
  if (code || !in) return std::nullopt;
  std::optional<FilePart> part = FilePart{0, size};
  for (const std::string_view type : {"moov", "udta", "GPMF"})
    if (part) part = box_in(in, *part, type);
  if (!part || part->end - part->begin > kMaxHeader_bytes) return std::nullopt;
  GoproHeader header;
  take_all(bytes_at(in, part->begin, static_cast<std::size_t>(part->end - part->begin)), 0, header);
  return header;
}

}  // namespace sigs

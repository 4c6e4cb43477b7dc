// SPDX-License-Identifier: MIT
#include "telemetry/gpmf.h"

#include <algorithm>
#include <cstdint>
#include <fstream>
#include <limits>
#include <string_view>
#include <system_error>

#include "base/input_file.h"
#include "base/pose.h"
#include "base/text.h"
#include "telemetry/binary_numbers.h"

namespace sigs {
namespace {

constexpr std::size_t kElementHeader_bytes = 8;
constexpr std::size_t kMaxColumns = 255;  // a sample has at most 255 bytes

constexpr LetterType kGpmfTypes[] = {
    {'b', kNumberType<std::int8_t>},
    {'B', kNumberType<std::uint8_t>},
    {'c', {1}},
    {'s', kNumberType<std::int16_t>},
    {'S', kNumberType<std::uint16_t>},
    {'f', kNumberType<float>},
    {'F', {4}},
    {'l', kNumberType<std::int32_t>},
    {'L', kNumberType<std::uint32_t>},
    {'q', kNumberType<std::int32_t>, 0x1p-16},
    {'d', kNumberType<double>},
    {'j', kNumberType<std::int64_t>},
    {'J', kNumberType<std::uint64_t>},
    {'Q', kNumberType<std::int64_t>, 0x1p-32},
    {'G', {16}},
    {'U', {16}},
};

// Bytes of one number of a type; 0: no such type.
int size_of_type(char type) {
  return static_cast<int>(type_of_letter(kGpmfTypes, type).type.bytes);
}

// The count in brackets behind a type, taken off the structure: "[8]L" gives 8 and leaves "L". 1 where there is none.
std::size_t count_behind(std::string_view& structure) {
  if (!structure.starts_with('[')) return 1;
  std::size_t count = 0;
  std::size_t i = 1;
  for (; i < structure.size() && structure[i] >= '0' && structure[i] <= '9'; ++i)
    count = std::min(count * 10 + static_cast<std::size_t>(structure[i] - '0'), kMaxColumns + 1);
  structure.remove_prefix(std::min(i + 1, structure.size()));
  return count;
}

// The types of one sample's columns, one character each; empty where they do not fill the sample.
std::string columns_of(const GpmfElement& element, std::string_view structure) {
  std::string types;
  if (element.type == '?') {
    while (!structure.empty() && types.size() <= kMaxColumns) {
      const char type = structure.front();
      structure.remove_prefix(1);
      types.append(count_behind(structure), type);
    }
  } else if (const int bytes = size_of_type(element.type); bytes > 0 && element.size % bytes == 0) {
    types.append(static_cast<std::size_t>(element.size / bytes), element.type);
  }
  int bytes = 0;
  for (const char type : types) {
    if (size_of_type(type) == 0) return {};
    bytes += size_of_type(type);
  }
  return bytes == element.size ? types : std::string();
}

bool is_key(std::string_view key) {
  return std::all_of(key.begin(), key.end(), [](char c) { return c >= ' ' && c <= '~'; });
}

}  // namespace

GpmfLevel gpmf_level(std::string_view value, std::int64_t at) {
  GpmfLevel level;
  std::size_t i = 0;
  while (i < value.size()) {
    const std::string_view rest = value.substr(i);
    const std::int64_t here = at + static_cast<std::int64_t>(i);
    if (rest.size() < kElementHeader_bytes || !is_key(rest.substr(0, 4))) {
      if (rest.find_first_not_of('\0') != std::string_view::npos) level.broken_at = here;  // else it is padding
      return level;
    }
    GpmfElement element{.key = rest.substr(0, 4), .type = rest[4], .at = here};
    element.size = static_cast<unsigned char>(rest[5]);
    element.repeat = static_cast<int>(big_endian(rest.substr(6, 2)));
    const std::size_t bytes = static_cast<std::size_t>(element.size) * static_cast<std::size_t>(element.repeat);
    if (bytes > rest.size() - kElementHeader_bytes) {
      level.broken_at = here;
      // Of elements in one that is cut off, the first may be whole.
      if (element.type == 0) {
        element.value = rest.substr(kElementHeader_bytes);
        level.elements.push_back(element);
      }
      return level;
    }
    element.value = rest.substr(kElementHeader_bytes, bytes);
    level.elements.push_back(element);
    i += kElementHeader_bytes + (bytes + 3) / 4 * 4;
  }
  return level;
}

std::optional<GpmfNumbers> gpmf_numbers(const GpmfElement& element, std::string_view structure) {
  const std::string types = columns_of(element, structure);
  if (types.empty()) return {};
  GpmfNumbers numbers{.columns = static_cast<int>(types.size())};
  numbers.values.reserve(types.size() * static_cast<std::size_t>(element.repeat));
  std::string_view rest = element.value;
  for (int row = 0; row < element.repeat; ++row) {
    for (const char type : types) {
      const LetterType letter = type_of_letter(kGpmfTypes, type);
      numbers.values.push_back(letter.type.number_of
                                   ? letter.type.number_of(big_endian(rest.substr(0, letter.type.bytes))) * letter.scale
                                   : std::numeric_limits<double>::quiet_NaN());
      rest.remove_prefix(letter.type.bytes);
    }
  }
  return numbers;
}

std::string gpmf_text(const GpmfElement& element) {
  return std::string(trimmed(element.value.substr(0, element.value.find('\0'))));
}

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
  return LoggedLens{.source = "GPMF ZFOV, " + number_text(*diagonal_fov_deg, 1) + " degrees across the diagonal",
                    .diagonal_fov_rad = rad_of_deg(*diagonal_fov_deg),
                    .is_fisheye = fov_letter != 'L'};
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

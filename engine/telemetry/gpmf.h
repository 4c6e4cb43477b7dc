// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "telemetry/track.h"

namespace sigs {

// GPMF, the General Purpose Metadata Format of GoPro (https://gopro.github.io/gpmf-parser): key, type, size, repeat and
// value, big endian, each padded to 4 bytes. Of what the keys mean only the file's header is here; all else is
// gopro.cpp's.

// One element. Views the payload that it was read from.
struct GpmfElement {
  std::string_view key;    // four characters
  char type = 0;           // of its numbers; 0: it contains elements; '?': as the TYPE before it says
  int size = 0;            // bytes of one sample
  int repeat = 0;          // samples
  std::string_view value;  // size * repeat bytes, without the padding
  std::int64_t at = 0;     // of the element in the payload, in bytes
};

// The elements of one level, up to the first that is broken: a key that is no text, or a length beyond the end. One
// that contains elements and is cut off is given with what is there of it.
struct GpmfLevel {
  std::vector<GpmfElement> elements;
  std::optional<std::int64_t> broken_at;  // where in the payload; nothing: it is sound
};

//   value  of an element of type 0, or a payload
//   at     of the value in the payload
[[nodiscard]] GpmfLevel gpmf_level(std::string_view value, std::int64_t at = 0);

// Samples as numbers, one row for each, each with the same number of columns.
struct GpmfNumbers {
  int columns = 0;
  std::vector<double> values;  // row by row; NaN for what is no number (text, IDs)

  [[nodiscard]] int rows() const { return columns > 0 ? static_cast<int>(values.size()) / columns : 0; }
  [[nodiscard]] double at(int row, int column) const {
    return values[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) + static_cast<std::size_t>(column)];
  }
};

// The numbers of an element. Nothing where the type is not known or does not fit the sample's size.
//   structure  the TYPE that holds for elements of type '?': "Lffffff", "f[8]L"
[[nodiscard]] std::optional<GpmfNumbers> gpmf_numbers(const GpmfElement& element, std::string_view structure = {});

// The text of an element, up to the first zero and without blanks at its ends; in what GoPro writes, Latin-1.
[[nodiscard]] std::string gpmf_text(const GpmfElement& element);

// What a GoPro writes once for a whole recording: the MP4 box moov/udta/GPMF, elements of gpmf.h.
//   ZFOV  diagonal field of view, degrees
//   VFOV  a letter: L linear, W wide, S SuperView, N narrow; all but the linear ones are fisheye images
//   EISE  Y: the camera has stabilised the images. EISA: how, "HS Boost"
struct GoproHeader {
  std::optional<double> diagonal_fov_deg;
  char fov_letter = 0;  // 0: not there
  bool is_stabilised = false;
  std::string stabilisation;  // EISA; may be empty

  // As far as the file states the field of view.
  [[nodiscard]] std::optional<LoggedLens> lens() const;
};

// Nothing where the file has no such box, is no MP4, or cannot be read. Reads the boxes' headers and at most 1 MiB.
[[nodiscard]] std::optional<GoproHeader> read_gopro_header(const std::filesystem::path& file);

}  // namespace sigs

// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "base/result.h"
#include "video/frame.h"
#include "video/libav/handles.h"

namespace sigs::libav {

// How a stored picture becomes upright: rows and columns swapped, then columns and rows in reverse. All eight ways in
// which a picture can be turned by right angles and mirrored are of this kind; each sample keeps its value.
struct Turn {
  bool transpose = false;
  bool flip_columns = false;
  bool flip_rows = false;

  [[nodiscard]] bool operator==(const Turn&) const = default;
};

// What the container's display matrix asks for (ISO/IEC 14496-12, 8.3.2.3; Matroska's projection pose).
// Error bad_data where it turns by other than right angles.
[[nodiscard]] Result<Turn> turn_of(const AVStream& stream);

// Error bad_data where the layout cannot be turned so: 4:2:2 on its side would be 4:4:0.
[[nodiscard]] Result<void> check_turn(const Turn& turn, PixelLayout layout);

[[nodiscard]] cv::Size turned(cv::Size size, const Turn& turn);
[[nodiscard]] Frame turned(const Frame& frame, const Turn& turn);

// Where chroma samples lie in the turned picture. Sites that have no name (on odd columns, on rows alone) are taken as
// midway, which is half a pixel beside them; exact says whether that happened.
struct TurnedSite {
  ChromaSite site = ChromaSite::left;
  bool exact = true;
};
[[nodiscard]] TurnedSite turned_site(ChromaSite site, PixelLayout layout, cv::Size stored_px, const Turn& turn);

// "rotated by 90 degrees clockwise", "mirrored left to right"; empty: as it is stored.
[[nodiscard]] std::string words_of(const Turn& turn);

}  // namespace sigs::libav

// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "base/result.h"
#include "video/frame.h"
#include "video/libav/handles.h"

namespace sigs::libav {

// How a stored image becomes upright: rows and columns swapped, then columns and rows in reverse. All eight ways in
// which an image can be oriented by right angles and mirrored are of this kind; each sample keeps its value.
struct Orientation {
  bool transpose = false;
  bool flip_columns = false;
  bool flip_rows = false;

  [[nodiscard]] bool operator==(const Orientation&) const = default;
};

// What the container's display matrix asks for (ISO/IEC 14496-12, 8.3.2.3; Matroska's projection pose).
// Error bad_data where it turns by other than right angles.
[[nodiscard]] Result<Orientation> orientation_of(const AVStream& stream);

// Error bad_data where the layout cannot be turned so: 4:2:2 on its side would be 4:4:0.
[[nodiscard]] Result<void> check_orientation(const Orientation& orientation, PixelLayout layout);

[[nodiscard]] cv::Size oriented(cv::Size size, const Orientation& orientation);
[[nodiscard]] Frame oriented(const Frame& frame, const Orientation& orientation);

// Where chroma samples lie in the turned image. Sites that have no name (on odd columns, on rows alone) are taken as
// midway, which is half a pixel beside them; exact says whether that happened.
struct OrientedSite {
  ChromaSite site = ChromaSite::left;
  bool exact = true;
};
[[nodiscard]] OrientedSite oriented_site(ChromaSite site, PixelLayout layout, cv::Size stored_px,
                                         const Orientation& orientation);

// "rotated by 90 degrees clockwise", "mirrored left to right"; empty: as it is stored.
[[nodiscard]] std::string description_of(const Orientation& orientation);

}  // namespace sigs::libav

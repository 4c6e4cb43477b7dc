// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "telemetry/track.h"

namespace sigs {

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

// SPDX-License-Identifier: MIT
#pragma once

#include <opencv2/core.hpp>
#include <optional>
#include <string>

namespace sigs {

// Linear light in BT.709's (sRGB's) red, green and blue to the same light in the footage's: white stays white, by
// Bradford's adaptation where the whites differ. primaries: an ISO/IEC 23091-2 (H.273) code point of ColourPrimaries;
// unspecified is taken for BT.709. Nothing for numbers that the standard does not define.
[[nodiscard]] std::optional<cv::Matx33d> from_bt709(int primaries);

// "BT.2020" for 9; "number 3" where the standard has none.
[[nodiscard]] std::string primaries_name(int primaries);

}  // namespace sigs

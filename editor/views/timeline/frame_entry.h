// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <span>
#include <string_view>

namespace sigs::editor {

// The frame that a person means who types into the frame field: "133"; "+10" and "-5" from the playhead; a time with a
// colon, "0:05.32" or "1:02:03.4", for the frame nearest to it in time (times_s: of each frame, ascending). Clamped to
// the footage; times_s empty: to 0 and above. None for what is no number.
[[nodiscard]] std::optional<int> frame_from_entry(std::string_view entry, int playhead,
                                                  std::span<const double> times_s);

}  // namespace sigs::editor

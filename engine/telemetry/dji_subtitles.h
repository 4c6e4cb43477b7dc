// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string_view>
#include <vector>

#include "base/result.h"
#include "telemetry/dji_cues.h"
#include "telemetry/read_track.h"
#include "telemetry/track.h"
#include "video/data_streams.h"

namespace sigs {

// The subtitles in which drones by DJI write their flight, as a file (.srt) or a stream of the video.

// Whether a file that begins so has them, or is one that has a subtitle's number and nothing else. Whether a stream of
// a container may have them.
[[nodiscard]] bool is_dji_subtitles(std::string_view head);
[[nodiscard]] bool is_dji_subtitle_stream(const DataStream& stream);

// Reads them. Times are those at which the subtitles are shown. Where they have none, they are the dates', with the
// first at 0. Dates are local time, so UTC is not known; own_times_s has them as if they were UTC. Of several heights
// the first is taken that the first place has: absolute (abs_alt), of an unknown zero (altitude), above the start
// (rel_alt, BAROMETER, Hb, H). Errors as those of read_track().
[[nodiscard]] Result<Track> read_dji_subtitles(const std::filesystem::path& file, const ReadTrackOptions& options);
[[nodiscard]] Result<Track> read_dji_subtitle_stream(const std::filesystem::path& file, const DataStream& stream,
                                                     const ReadTrackOptions& options);

// The track of the text of a file, or of cues in their order.
[[nodiscard]] Result<Track> dji_subtitles_track(std::string_view text, const std::filesystem::path& file);
[[nodiscard]] Result<Track> dji_cues_track(const std::vector<DjiCue>& cues, const std::filesystem::path& file);

}  // namespace sigs

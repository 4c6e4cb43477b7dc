// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "base/json.h"
#include "base/result.h"

namespace sigs {

// The data sheet of a dataset that has been made: what is in it, what it was made from, and how far its labels can be
// trusted. All of it is taken from the dataset's own files and from the inputs that its projects name. Nothing is
// supposed: what no file states stands as null in the JSON and as "not stated" in the text. docs/design-domain.md lists
// the parts.

// What `sigs init` guessed of a background's project, a line each, by the background's name.
using GuessesByBackground = std::map<std::string, std::vector<std::string>>;

// From index.json, NAME/NAME.json and NAME/NAME.xml of each video. Inputs (footage, calibration, models) that are not
// where the projects say have no checksum. Errors: cannot_read, bad_data that names the file; interrupted.
[[nodiscard]] Result<Json> data_sheet_of(const std::filesystem::path& dataset, const GuessesByBackground& guesses,
                                         const std::atomic<bool>* cancel = nullptr);

// The same as Markdown, for people.
[[nodiscard]] std::string data_sheet_text(const Json& sheet);

// The error that a calibration file states: the number after the first of the keys avg_reprojection_error,
// reprojection_error, rms_error, RMS_error and rms. None where it states none or is no text.
[[nodiscard]] std::optional<double> stated_reprojection_error_px(const std::string& calibration);

}  // namespace sigs

// SPDX-License-Identifier: MIT
#include "evaluation/report.h"

namespace sigs {

std::string table_text(const TrackReport&) {
  return {};
}

std::string table_text(const DetectionScore&) {
  return {};
}

Result<WrittenReport> write_report(const std::filesystem::path& folder, const TrackReport&) {
  return fail(folder.string(), "not yet", ErrorKind::unavailable);
}

Result<WrittenReport> write_report(const std::filesystem::path& folder, const std::vector<DetectionScore>&,
                                   const DetectionPolicy&) {
  return fail(folder.string(), "not yet", ErrorKind::unavailable);
}

}  // namespace sigs

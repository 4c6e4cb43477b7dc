// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string_view>
#include <vector>

#include "base/result.h"
#include "export/export_project.h"

namespace sigs {

// What follows the project's name in the files with the truth of a rig (rig/rig_truth.h).
inline constexpr std::string_view kRigSuffix = ".rig.json";
inline constexpr std::string_view kRigTableSuffix = ".rig.csv";

struct RigReport {
  std::vector<std::filesystem::path> written;
  std::vector<ExportReport> cameras;  // in the project's order
};

// export_project() of each camera of a project with several, as NAME.CAMERA.mkv and so on, and NAME.rig.json and
// NAME.rig.csv with what they see together. Cameras of the same footage are exported at the same time with one decoder,
// the others one after the other; models and calibrations are read once. The files of a camera get their names when
// that is complete, those of the rig last.
//   request  its frames count those of the first camera; the others have the frames of the same time. Its streams,
//            footage and files have no meaning
//   control  progress counts the frames of all cameras; warnings name the camera's project
// Errors as those of export_project().
[[nodiscard]] Result<RigReport> export_rig(const ExportRequest& request, const ExportControl& control);

}  // namespace sigs

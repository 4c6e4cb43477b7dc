// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "base/result.h"
#include "encounter/encounter.h"
#include "scene/scene.h"
#include "truth/annotation.h"

namespace sigs {

// The encounters of one export: of the camera with each intruder, from the first exported frame to the last. They are
// computed once; each frame takes its share. Memory: some 500 bytes for each frame and intruder.
class ExportedEncounters {
 public:
  // Errors name the project file: bad_project for a volume that there is not, bad_data where a path is not finite.
  [[nodiscard]] static Result<ExportedEncounters> of(const Project& project, const Scene& scene,
                                                     const FrameRange& frames);

  // Sets IntruderTruth::encounter of all intruders of a frame of the range.
  void add_to(FrameTruth& truth) const;

  // Writes what `sigs encounter --json` writes, at the steps of the exported frames, to an empty file. The source is
  // the project's name. Errors cannot_create, write_failed.
  [[nodiscard]] Result<void> write_json(const std::filesystem::path& path) const;

 private:
  std::string source_;
  std::vector<EncounterSummary> encounters_;  // by the intruder's id
  int first_frame_ = 0;
  std::vector<double> times_s_;  // of each frame
};

}  // namespace sigs

// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <opencv2/core.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/image.h"
#include "base/result.h"
#include "editor/document/content_id.h"
#include "editor/document/document.h"
#include "scene/scene_files.h"

namespace sigs::editor {

// What boxes have to lie in: the footage of the active camera.
struct FootageBounds {
  cv::Size size_px;
  int frames = 0;
};

// The boxes of a file, sorted by frame. The same label in several frames is the same aircraft.
using RealAircraftBoxes = std::vector<RealAircraftBox>;

// Those of one frame; valid for as long as the boxes do not change.
[[nodiscard]] std::span<const RealAircraftBox> boxes_of_frame(const RealAircraftBoxes& boxes, int frame);

// Whether the box of this index was filled in between others: it lies on the straight line between those of its
// aircraft in the frames before and after, and its line reads as with_box() writes it.
[[nodiscard]] bool is_filled(const RealAircraftBoxes& boxes, std::size_t index);

// With a box of an aircraft in this frame, in place of one that it has there. The frames from there to its nearest
// boxes before and after that are not filled in are filled. The box is clipped to the image. Errors: the frame is not
// of the footage; less than one pixel of the box lies within the image, in width or in height.
[[nodiscard]] Result<RealAircraftBoxes> with_box(const RealAircraftBoxes& boxes, const std::string& label, int frame,
                                                 const Box& box, const FootageBounds& footage);

// The boxes of aircraft that the footage of the active camera shows, as they are marked: those of the file that
// footage.real_aircraft names. Each change is written at once, as a file that appears when it is complete, so nothing
// is ever unsaved. The changes can be undone as long as nobody else changes the file or the setting. Knows no window.
class RealAircraftSession {
 public:
  // Once per update in which boxes are shown. Reads the file where it is another one or was changed. True: another
  // document, or another camera, is looked at.
  bool follow(const Document& document);

  [[nodiscard]] const RealAircraftBoxes& boxes() const { return *boxes_; }
  // A label that no box has: "aircraft 1", ...
  [[nodiscard]] std::string new_label() const;
  // Whether the label names one aircraft: it is in no frame twice.
  [[nodiscard]] bool is_track(const std::string& label) const;

  // Each writes the file: where the project names none a new one beside it, PROJECT.real.csv, which the project then
  // names by an edit. Errors change nothing: those of with_box(); the project has no file yet; what is in the file
  // cannot be read, or another program has changed it; it cannot be written.
  Result<void> mark(const Document& document, Edits& edits, const std::string& label, int frame, const Box& box,
                    const FootageBounds& footage);
  Result<void> remove(const Document& document, Edits& edits, const RealAircraftBox& box);
  Result<void> remove_all(const Document& document, Edits& edits, const std::string& label);

  [[nodiscard]] bool can_undo() const { return !past_.empty(); }
  [[nodiscard]] bool can_redo() const { return !future_.empty(); }
  // Without anything to undo or redo nothing happens.
  Result<void> undo(const Document& document, Edits& edits);
  Result<void> redo(const Document& document, Edits& edits);

 private:
  // States never change, so that history shares them.
  using State = std::shared_ptr<const RealAircraftBoxes>;

  void read();
  Result<void> change(const Document& document, Edits& edits, RealAircraftBoxes boxes);
  Result<void> write(const Document& document, Edits& edits, const State& boxes);
  // To the last state of `from`; the present one is put at the end of `to`.
  Result<void> step(const Document& document, Edits& edits, std::vector<State>& from, std::vector<State>& to);

  FileStamp stamp_;  // of the file as it was read or written last; path "": none is named
  std::string header_;
  State boxes_ = std::make_shared<const RealAircraftBoxes>();
  std::optional<Error> problem_;  // why the file could not be read
  std::vector<State> past_;
  std::vector<State> future_;
  // What is looked at.
  std::uint64_t document_ = 0;
  std::size_t camera_ = 0;
};

}  // namespace sigs::editor

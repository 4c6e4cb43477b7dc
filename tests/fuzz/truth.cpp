// SPDX-License-Identifier: MIT
#include <cmath>

#include "base/ensure.h"
#include "evaluation/readers/aot_files.h"
#include "evaluation/readers/clip_truth.h"
#include "evaluation/readers/truth_files.h"
#include "fuzz/fuzz_input.h"

namespace sigs::fuzz {

namespace {

namespace fs = std::filesystem;

void check_clip(const ClipTruth& clip) {
  const int frames = clip.footage.last_frame - clip.footage.first_frame + 1;
  ENSURE(frames > 0 && clip.frames() == frames);
  for (const TargetTruth& target : clip.targets) {
    ENSURE(target.frames.size() == clip.times_s.size());
    for (const TargetFrame& frame : target.frames)
      if (frame.visible) ENSURE(std::isfinite(frame.visible->x) && std::isfinite(frame.visible->width));
  }
}

template <class Clips>
void check_clips_or_message(const Clips& clips) {
  if (!clips) return check_message(clips.error());
  for (const TruthClip& clip : *clips) check_clip(clip.truth);
}

// The input as the file of this name in a folder of its own.
FuzzInput made_file(const FuzzInput& input, const fs::path& name) {
  const fs::path folder = input.folder / name.parent_path();
  fs::create_directories(folder);
  const FuzzInput there{input.bytes, folder};
  static_cast<void>(there.file(name.filename()));
  return there;
}

void try_sequence_folder(const FuzzInput& input, const char* folder, const char* name) {
  const Result<SequenceTruth> sequence = read_sequence_truth(made_file(input, fs::path(folder) / name).folder);
  if (sequence)
    check_clip(sequence->truth);
  else
    check_message(sequence.error());
}

}  // namespace

void try_truth(const FuzzInput& input) {
  const Result<ClipTruth> xml = read_truth(input.file("labels.xml"));
  if (xml)
    check_clip(*xml);
  else
    check_message(xml.error());
  const fs::path json = input.file("truth.json");
  check_clips_or_message(read_truth_clips(json));
  if (const auto truth = read_aot_truth(json); !truth) check_message(truth.error());
  if (const auto reports = read_aot_reports(json); !reports) check_message(reports.error());
  static_cast<void>(made_file(input, "mot/gt/gt.txt"));
  check_clips_or_message(read_truth_clips(input.folder / "mot"));
  static_cast<void>(made_file(input, "info/seqinfo.ini"));
  static_cast<void>(made_file({"1,1,2,3,4,5,1,1,1\n", input.folder}, "info/gt/gt.txt"));
  check_clips_or_message(read_truth_clips(input.folder / "info"));
  static_cast<void>(made_file(input, "yolo/labels/1.txt"));
  check_clips_or_message(read_truth_clips(input.folder / "yolo", {.size_px = {64, 48}, .rate_hz = 25}));
  try_sequence_folder(input, "otb", "groundtruth_rect.txt");
  try_sequence_folder(input, "vot", "groundtruth.txt");
}

}  // namespace sigs::fuzz

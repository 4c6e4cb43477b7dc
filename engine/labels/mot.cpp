// SPDX-License-Identifier: MIT
#include "labels/formats.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "base/staged_outputs.h"
#include "base/text.h"
#include "labels/label_files.h"
#include "labels/label_text.h"

namespace sigs {

namespace {

namespace fs = std::filesystem;

// MOT16's class "distractor" (Milan et al. 2016, table 2): a report that matches one counts neither for nor against a
// tracker. Where there are 8 categories or more, what is ignored has the number after the last of them.
constexpr int kDistractor = 8;

int ignored_class(const LabelSequence& sequence) {
  const int categories = static_cast<int>(sequence.categories.size());
  return categories < kDistractor ? kDistractor : categories + 1;
}

// frame, id, left, top, width, height, 1 to count or 0 to ignore, class, visibility. The first pixel is 1, 1.
std::string mot_row(int frame, int id, const cv::Rect& box, bool counts, int category, double visibility) {
  return fmt::format("{},{},{},{},{},{},{:d},{},{}\n", frame, id, box.x + 1, box.y + 1, box.width, box.height, counts,
                     category, number_text(visibility, kLabelDecimals));
}

// After the ids of the intruders.
int first_own_body_id(const LabelSequence& sequence) {
  int last = 0;
  for (const LabelledIntruder& intruder : sequence.intruders) last = std::max(last, intruder.id + 1);
  return last + 1;
}

std::string seqinfo(const LabelSequence& sequence, const std::string& name) {
  const FootageTruth& footage = sequence.footage;
  std::string text = fmt::format(
      "[Sequence]\nname={}\nimDir=img1\nframeRate={}\nseqLength={}\nimWidth={}\nimHeight={}\nimExt={}\n"
      "exactFrameRate={}\n{}\n[Classes]\n",
      name, whole_rate_hz(footage), frame_count(footage), footage.size_px.width, footage.size_px.height,
      sequence.image_extension, rate_text(footage),
      sequence.mounted ? fmt::format("camera={}\n", line_name(sequence.mounted->name)) : "");
  for (std::size_t i = 0; i < sequence.categories.size(); ++i)
    text += fmt::format("{}={}\n", i + 1, line_name(sequence.categories[i]));
  if (!sequence.own_body.empty()) text += fmt::format("{}=own body, ignored\n", ignored_class(sequence));
  if (sequence.own_body.empty() && sequence.has_real_aircraft)
    text += fmt::format("{}=real aircraft, ignored\n", ignored_class(sequence));
  return text;
}

class MotLabels : public LabelWriter {
 public:
  MotLabels(fs::path folder, TextFile truth, LabelSequence sequence)
      : folder_(std::move(folder)),
        truth_(std::move(truth)),
        sequence_(std::move(sequence)),
        own_body_(own_body_boxes(sequence_.own_body)) {}

  Result<void> write(const FrameTruth& truth) override {
    const int frame = truth.index - sequence_.footage.first_frame + 1;
    std::string text;
    for (const IntruderTruth& intruder : truth.intruders)
      if (is_labelled(intruder, sequence_.thresholds))
        text += mot_row(frame, intruder.id + 1, *intruder.visible_box, true, category_index(sequence_, intruder.id) + 1,
                        intruder.visible_fraction);
    int id = first_own_body_id(sequence_);
    for (const cv::Rect& box : own_body_) text += mot_row(frame, id++, box, false, ignored_class(sequence_), 1);
    for (const cv::Rect& box : truth.real_aircraft)
      text += mot_row(frame, id++, box, false, ignored_class(sequence_), 1);
    return truth_.put(text);
  }

  Result<void> finish(const fs::path& images) override {
    if (const Result<void> closed = truth_.close(); !closed) return closed;
    return link_numbered_images(images, sequence_.footage, folder_ / "img1",
                                {.first = 1, .digits = 6, .extension = sequence_.image_extension});
  }

 private:
  fs::path folder_;
  TextFile truth_;
  LabelSequence sequence_;
  std::vector<cv::Rect> own_body_;
};

}  // namespace

Result<std::unique_ptr<LabelWriter>> open_mot(const fs::path& path, const LabelSequence& sequence) {
  const std::string name = line_name(sequence.name);
  for (const fs::path& folder : {path / "seqmaps", path / name / "gt"})
    if (const Result<void> created = make_inner_folder(folder); !created) return fail(created.error());
  const Result<void> map =
      write_text(path / "seqmaps" / (name + ".txt"), fmt::format("name\n{}\n", csv_field(name)), false);
  if (!map) return fail(map.error());
  const Result<void> info = write_text(path / name / "seqinfo.ini", seqinfo(sequence, name), false);
  if (!info) return fail(info.error());
  Result<TextFile> truth = TextFile::create(path / name / "gt" / "gt.txt");
  if (!truth) return fail(truth.error());
  return std::make_unique<MotLabels>(path / name, std::move(*truth), sequence);
}

}  // namespace sigs

// SPDX-License-Identifier: MIT
#include "labels/mot.h"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "base/staged_outputs.h"
#include "base/text.h"
#include "labels/label_text.h"
#include "labels/numbered_images.h"
#include "labels/own_body_boxes.h"
#include "labels/text_file.h"

namespace sigs {

namespace {

namespace fs = std::filesystem;

constexpr int kFractionDecimals = 6;

// MOT16's class "distractor" (Milan et al. 2016, table 2): a report that matches one counts neither for nor against a
// tracker. Where so many categories are counted that 8 is one of them, the number behind them.
constexpr int kDistractor = 8;

int own_body_class(const LabelSequence& sequence) {
  const int categories = static_cast<int>(sequence.categories.size());
  return categories < kDistractor ? kDistractor : categories + 1;
}

// frame, id, left, top, width, height, 1 to count or 0 to ignore, class, visibility. The first pixel is 1, 1.
std::string row(int frame, int id, const cv::Rect& box, bool counts, int category, double visibility) {
  std::string text;
  for (const int number : {frame, id, box.x + 1, box.y + 1, box.width, box.height, counts ? 1 : 0, category})
    text += std::to_string(number) + ",";
  return text + number_text(visibility, kFractionDecimals) + "\n";
}

// Behind the ids of the intruders.
int first_own_body_id(const LabelSequence& sequence) {
  int last = 0;
  for (const LabelledIntruder& intruder : sequence.intruders) last = std::max(last, intruder.id + 1);
  return last + 1;
}

std::string seqinfo(const LabelSequence& sequence, const std::string& name) {
  const FootageTruth& footage = sequence.footage;
  std::string text = "[Sequence]\nname=" + name + "\nimDir=img1\nframeRate=" + std::to_string(whole_rate_hz(footage)) +
                     "\nseqLength=" + std::to_string(footage.last_frame - footage.first_frame + 1) +
                     "\nimWidth=" + std::to_string(footage.size_px.width) +
                     "\nimHeight=" + std::to_string(footage.size_px.height) +
                     "\nimExt=.png\nexactFrameRate=" + rate_text(footage) + "\n\n[Classes]\n";
  for (std::size_t i = 0; i < sequence.categories.size(); ++i)
    text += std::to_string(i + 1) + "=" + line_name(sequence.categories[i]) + "\n";
  if (!sequence.own_body.empty()) text += std::to_string(own_body_class(sequence)) + "=own body, ignored\n";
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
        text += row(frame, intruder.id + 1, *intruder.visible_box, true, category_index(sequence_, intruder.id) + 1,
                    intruder.visible_fraction);
    int id = first_own_body_id(sequence_);
    for (const cv::Rect& box : own_body_) text += row(frame, id++, box, false, own_body_class(sequence_), 1);
    return truth_.put(text);
  }

  Result<void> finish(const fs::path& images) override {
    if (const Result<void> closed = truth_.close(); !closed) return closed;
    return link_numbered_images(images, sequence_.footage, folder_ / "img1", {.first = 1, .digits = 6});
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
    if (const Result<void> made = make_inner_folder(folder); !made) return fail(made.error());
  const Result<void> map = write_text(path / "seqmaps" / (name + ".txt"), "name\n" + csv_field(name) + "\n", false);
  if (!map) return fail(map.error());
  const Result<void> info = write_text(path / name / "seqinfo.ini", seqinfo(sequence, name), false);
  if (!info) return fail(info.error());
  Result<TextFile> truth = TextFile::create(path / name / "gt" / "gt.txt");
  if (!truth) return fail(truth.error());
  return std::make_unique<MotLabels>(path / name, std::move(*truth), sequence);
}

}  // namespace sigs

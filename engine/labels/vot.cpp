// SPDX-License-Identifier: MIT
#include "labels/formats.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string>
#include <utility>
#include <vector>

#include "base/staged_outputs.h"
#include "base/text.h"
#include "labels/label_files.h"
#include "labels/label_text.h"
#include "truth/measure.h"

namespace sigs {

namespace {

namespace fs = std::filesystem;

// A value of a line "key=value": the toolkit reads a backslash as the escape of the next character.
std::string value_text(const std::string& text) {
  std::string value;
  for (const char c : text) {
    if (c == '\\' || c == '=') value += '\\';
    value += c;
  }
  return value;
}

std::string sequence_text(const LabelSequence& sequence, const std::string& name) {
  const FootageTruth& footage = sequence.footage;
  return fmt::format("channels.color=color/%08d{}\nfps={}\nframe_rate={}\nheight={}\nlength={}\nname={}\nwidth={}\n",
                     sequence.image_extension, whole_rate_hz(footage), rate_text(footage), footage.size_px.height,
                     frame_count(footage), value_text(name), footage.size_px.width);
}

// The toolkit writes and reads an absent target as four NaN, as in its long-term challenges.
std::string region_text(const cv::Rect* box) {
  if (box == nullptr) return "nan,nan,nan,nan";
  return fmt::format("{},{},{},{}", box->x, box->y, box->width, box->height);
}

// The sequence of one target: files with a line for each frame.
class VotSequence {
 public:
  static Result<VotSequence> create(fs::path folder, const LabelSequence& sequence) {
    if (const Result<void> created = make_inner_folder(folder); !created) return fail(created.error());
    const std::string text = sequence_text(sequence, folder.filename().string());
    if (const Result<void> head = write_text(folder / "sequence", text, false); !head) return fail(head.error());
    std::vector<TextFile> files;
    for (const char* name : kFiles) {
      Result<TextFile> file = TextFile::create(folder / name);
      if (!file) return fail(file.error());
      files.push_back(std::move(*file));
    }
    return VotSequence(std::move(folder), std::move(files));
  }

  // nullptr: the frame has no such intruder.
  [[nodiscard]] Result<void> write(const IntruderTruth* truth, const LabelThresholds& thresholds) {
    const bool is_there = truth != nullptr && is_labelled(*truth, thresholds);
    appears_ = appears_ || is_there;
    const std::array<std::string, kFiles.size()> lines{
        region_text(is_there ? &*truth->visible_box : nullptr), is_there ? "0" : "1",
        is_there && is_occluded(*truth) ? "1" : "0",
        number_text(truth == nullptr ? 0 : glm::length(truth->position_m), kLabelDecimals),
        number_text(truth == nullptr ? 0 : truth->visible_fraction, kLabelDecimals)};
    for (std::size_t i = 0; i < lines.size(); ++i)
      if (const Result<void> put = files_[i].put(lines[i] + "\n"); !put) return put;
    return {};
  }

  [[nodiscard]] Result<void> finish(const fs::path& images, const LabelSequence& sequence) {
    for (TextFile& file : files_)
      if (const Result<void> closed = file.close(); !closed) return closed;
    return link_numbered_images(images, sequence.footage, folder_ / "color",
                                {.first = 1, .digits = 8, .extension = sequence.image_extension});
  }

  [[nodiscard]] std::string name() const { return folder_.filename().string(); }
  [[nodiscard]] bool appears() const { return appears_; }

 private:
  static constexpr std::array<const char*, 5> kFiles{"groundtruth.txt", "absence.tag", "occlusion.tag",
                                                     "distance_m.value", "visible_fraction.value"};
  VotSequence(fs::path folder, std::vector<TextFile> files) : folder_(std::move(folder)), files_(std::move(files)) {}

  fs::path folder_;
  std::vector<TextFile> files_;
  bool appears_ = false;
};

class VotLabels : public LabelWriter {
 public:
  VotLabels(fs::path folder, LabelSequence sequence, std::vector<VotSequence> targets)
      : folder_(std::move(folder)), sequence_(std::move(sequence)), targets_(std::move(targets)) {}

  Result<void> write(const FrameTruth& truth) override {
    for (std::size_t i = 0; i < targets_.size(); ++i) {
      const int id = sequence_.intruders[i].id;
      const auto found = std::ranges::find(truth.intruders, id, &IntruderTruth::id);
      const IntruderTruth* target = found == truth.intruders.end() ? nullptr : &*found;
      if (const Result<void> written = targets_[i].write(target, sequence_.thresholds); !written) return written;
    }
    return {};
  }

  Result<void> finish(const fs::path& images) override {
    std::string list;
    for (VotSequence& target : targets_) {
      if (const Result<void> finished = target.finish(images, sequence_); !finished) return finished;
      // A sequence in which the target never appears gives a tracker nothing to begin with.
      if (target.appears()) list += target.name() + "\n";
    }
    return write_text(folder_ / "list.txt", list, false);
  }

 private:
  fs::path folder_;
  LabelSequence sequence_;
  std::vector<VotSequence> targets_;
};

}  // namespace

Result<std::unique_ptr<LabelWriter>> open_vot(const fs::path& path, const LabelSequence& sequence) {
  const std::string name = line_name(sequence.name);
  std::vector<VotSequence> targets;
  for (const LabelledIntruder& intruder : sequence.intruders) {
    const std::string folder = sequence.intruders.size() == 1 ? name : fmt::format("{}-{}", name, intruder.id);
    Result<VotSequence> target = VotSequence::create(path / folder, sequence);
    if (!target) return fail(target.error());
    targets.push_back(std::move(*target));
  }
  return std::make_unique<VotLabels>(path, sequence, std::move(targets));
}

}  // namespace sigs

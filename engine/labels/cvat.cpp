// SPDX-License-Identifier: MIT
#include "labels/formats.h"

#include <fmt/format.h>

#include <map>
#include <pugixml.hpp>
#include <sstream>
#include <utility>

#include "labels/label_files.h"
#include "labels/label_text.h"
#include "truth/measure.h"

namespace sigs {

namespace {

// A box of a track in one frame.
struct TrackBox {
  int frame = 0;
  bool is_outside = false;  // the intruder has left; the box is its last one
  bool is_occluded = false;
  cv::Rect box;
};

// The declaration, the opening tag of the document and its element "meta".
std::string cvat_head(const LabelSequence& sequence) {
  const FootageTruth& footage = sequence.footage;
  const int last = frame_count(footage) - 1;
  pugi::xml_document document;
  pugi::xml_node meta = document.append_child("meta");
  pugi::xml_node task = meta.append_child("task");
  add_element(task, "id", 0);
  add_element(task, "name", sequence.name);
  add_element(task, "size", last + 1);
  add_element(task, "mode", "interpolation");
  add_element(task, "overlap", 0);
  add_element(task, "bugtracker", "");
  add_element(task, "flipped", "False");
  add_element(task, "start_frame", 0);
  add_element(task, "stop_frame", last);
  add_element(task, "frame_filter", "");
  pugi::xml_node labels = task.append_child("labels");
  for (const std::string& category : sequence.categories) {
    pugi::xml_node label = labels.append_child("label");
    add_element(label, "name", category);
    label.append_child("attributes");
  }
  pugi::xml_node segment = task.append_child("segments").append_child("segment");
  add_element(segment, "id", 0);
  add_element(segment, "start", 0);
  add_element(segment, "stop", last);
  pugi::xml_node size = task.append_child("original_size");
  add_element(size, "width", footage.size_px.width);
  add_element(size, "height", footage.size_px.height);
  add_element(meta, "source", sequence.video.empty() ? sequence.images : sequence.video);
  std::ostringstream text;
  text << "<?xml version=\"1.0\" encoding=\"utf-8\"?>\n<annotations>\n  <version>1.1</version>\n";
  meta.print(text, "  ", pugi::format_default, pugi::encoding_utf8, 1);
  return text.str();
}

// CVAT writes coordinates with two digits after the point.
std::string box_element(const TrackBox& shape) {
  const cv::Rect& box = shape.box;
  return fmt::format(
      "    <box frame=\"{}\" keyframe=\"1\" outside=\"{:d}\" occluded=\"{:d}\" "
      "xtl=\"{}.00\" ytl=\"{}.00\" xbr=\"{}.00\" ybr=\"{}.00\" z_order=\"0\"/>\n",
      shape.frame, shape.is_outside, shape.is_occluded, box.x, box.y, box.x + box.width, box.y + box.height);
}

class CvatLabels : public OneFileLabels {
 public:
  using OneFileLabels::OneFileLabels;

  // Frames arrive in order; the file has one track after the other, so all boxes are kept until the end.
  Result<void> write(const FrameTruth& truth) override {
    const int frame = truth.index - sequence_.footage.first_frame;
    for (const IntruderTruth& intruder : truth.intruders) {
      if (is_labelled(intruder, sequence_.thresholds))
        tracks_[intruder.id].push_back(
            {.frame = frame, .is_occluded = is_occluded(intruder), .box = *intruder.visible_box});
      else if (const auto track = tracks_.find(intruder.id); track != tracks_.end() && !track->second.back().is_outside)
        track->second.push_back({.frame = frame, .is_outside = true, .box = track->second.back().box});
    }
    return {};
  }

  Result<void> finish(const std::filesystem::path&) override {
    if (const Result<void> put = file_.put(cvat_head(sequence_)); !put) return put;
    for (const auto& [id, boxes] : tracks_)
      if (const Result<void> put = put_track(id, boxes); !put) return put;
    if (const Result<void> put = file_.put("</annotations>\n"); !put) return put;
    return file_.close();
  }

 private:
  Result<void> put_track(int id, const std::vector<TrackBox>& boxes) {
    const std::string& category = sequence_.categories[static_cast<std::size_t>(category_index(sequence_, id))];
    // A reader would turn line breaks and tabs of an attribute into blanks (XML 1.0 section 3.3.3).
    const std::string head = fmt::format("  <track id=\"{}\" label=\"{}\" source=\"file\">\n", id,
                                         escaped_text(xml_text(category), "\t\n\r"));
    if (const Result<void> put = file_.put(head); !put) return put;
    for (const TrackBox& box : boxes)
      if (const Result<void> put = file_.put(box_element(box)); !put) return put;
    return file_.put("  </track>\n");
  }

  std::map<int, std::vector<TrackBox>> tracks_;  // by intruder
};

}  // namespace

Result<std::unique_ptr<LabelWriter>> open_cvat(const std::filesystem::path& path, const LabelSequence& sequence) {
  return begun_file<CvatLabels>(path, sequence);
}

}  // namespace sigs

// SPDX-License-Identifier: MIT
#include "labels/cvat.h"

#include <map>
#include <pugixml.hpp>
#include <sstream>
#include <utility>

#include "labels/label_text.h"
#include "labels/text_file.h"
#include "labels/xml_elements.h"
#include "labels/xml_text.h"
#include "truth/measure.h"

namespace sigs {

namespace {

struct TrackBox {
  int frame = 0;
  bool is_outside = false;
  bool is_occluded = false;
  cv::Rect box;
};

std::string head_of(const LabelSequence& sequence) {
  const FootageTruth& footage = sequence.footage;
  const int last = footage.last_frame - footage.first_frame;
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

// An attribute's text between double quotes (XML 1.0 sections 2.3 and 3.3.3).
std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : xml_text(text)) switch (c) {
      case '&':
        out += "&amp;";
        break;
      case '<':
        out += "&lt;";
        break;
      case '>':
        out += "&gt;";
        break;
      case '"':
        out += "&quot;";
        break;
      case '\t':
      case '\n':
      case '\r':  // raw, a reader makes a space of it
        out += "&#" + std::to_string(static_cast<int>(c)) + ";";
        break;
      default:
        out += c;
    }
  return out;
}

std::string attribute(const char* name, int number) {
  return std::string(" ") + name + "=\"" + std::to_string(number) + "\"";
}

// CVAT writes places with two digits after the point.
std::string place(const char* name, int pixels) {
  return std::string(" ") + name + "=\"" + std::to_string(pixels) + ".00\"";
}

std::string text_of(const TrackBox& shape) {
  return "    <box" + attribute("frame", shape.frame) + attribute("keyframe", 1) +
         attribute("outside", shape.is_outside ? 1 : 0) + attribute("occluded", shape.is_occluded ? 1 : 0) +
         place("xtl", shape.box.x) + place("ytl", shape.box.y) + place("xbr", shape.box.x + shape.box.width) +
         place("ybr", shape.box.y + shape.box.height) + attribute("z_order", 0) + "/>\n";
}

class CvatLabels : public LabelWriter {
 public:
  CvatLabels(TextFile file, const LabelSequence& sequence) : file_(std::move(file)), sequence_(sequence) {}

  // Frame by frame they come, track by track they are written.
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
    if (const Result<void> put = file_.put(head_of(sequence_)); !put) return put;
    for (const auto& [id, boxes] : tracks_)
      if (const Result<void> put = put_track(id, boxes); !put) return put;
    if (const Result<void> put = file_.put("</annotations>\n"); !put) return put;
    return file_.close();
  }

 private:
  Result<void> put_track(int id, const std::vector<TrackBox>& boxes) {
    const std::string& category = sequence_.categories[static_cast<std::size_t>(category_index(sequence_, id))];
    const std::string head =
        "  <track" + attribute("id", id) + " label=\"" + escaped(category) + "\" source=\"file\">\n";
    if (const Result<void> put = file_.put(head); !put) return put;
    for (const TrackBox& box : boxes)
      if (const Result<void> put = file_.put(text_of(box)); !put) return put;
    return file_.put("  </track>\n");
  }

  TextFile file_;
  LabelSequence sequence_;
  std::map<int, std::vector<TrackBox>> tracks_;  // by intruder
};

}  // namespace

Result<std::unique_ptr<LabelWriter>> open_cvat(const std::filesystem::path& path, const LabelSequence& sequence) {
  Result<TextFile> file = TextFile::create(path);
  if (!file) return fail(file.error());
  return std::make_unique<CvatLabels>(std::move(*file), sequence);
}

}  // namespace sigs

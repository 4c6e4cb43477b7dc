// SPDX-License-Identifier: MIT
#include "labels/formats.h"

#include <cmath>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <utility>

#include "base/ensure.h"
#include "base/pose.h"
#include "labels/label_files.h"
#include "labels/label_text.h"

namespace sigs {

namespace {

using Json = nlohmann::ordered_json;

constexpr int kVideoId = 1;

// To the digits of the other formats.
double rounded(double number) {
  ENSURE(std::isfinite(number));
  return std::round(number * 1e6) / 1e6 + 0.0;  // no sign on a zero
}

Json json_of(const cv::Rect& box) {
  return {box.x, box.y, box.width, box.height};
}

// The origin is the centre of the first pixel in Box, its upper left corner in COCO.
Json json_of(const Box& box) {
  return {rounded(box.x + 0.5), rounded(box.y + 0.5), rounded(box.width), rounded(box.height)};
}

Json json_of(const glm::dvec3& point) {
  return {rounded(point.x), rounded(point.y), rounded(point.z)};
}

Json json_of(const Attitude& attitude) {
  return {{"roll", rounded(deg_of_rad(attitude.roll_rad))},
          {"pitch", rounded(deg_of_rad(attitude.pitch_rad))},
          {"yaw", rounded(deg_of_rad(attitude.yaw_rad))}};
}

Json appearance_of(const IntruderTruth& intruder) {
  Json appearance = Json::object();
  for (const LabelNumber& number : appearance_numbers(intruder)) appearance[number.name] = rounded(number.value);
  return appearance;
}

Json rle_of(const cv::Mat& mask, const cv::Rect& box, cv::Size image) {
  return {{"size", {image.height, image.width}}, {"counts", coco_counts(column_runs(mask, box, image))}};
}

Json info_of(const LabelSequence& sequence) {
  return {{"description", sequence.name},
          {"version", "1.0"},
          {"contributor", "SIGS"},
          {"min_pixels", sequence.thresholds.min_pixels},
          {"min_visible_fraction", rounded(sequence.thresholds.min_visible_fraction)}};
}

// One of several cameras: its lens, whose pixels count from the centre of the first one, and where it sits.
Json camera_of(const MountedCamera& mounted, const std::optional<Camera>& camera) {
  Json json{{"name", mounted.name}};
  if (camera) {
    const LensParameters& lens = camera->lens.parameters();
    json["lens"] = {
        {"model", name_of(lens.model)},     {"fx", lens.fx}, {"fy", lens.fy}, {"cx", lens.cx}, {"cy", lens.cy},
        {"coefficients", lens.coefficients}};
  }
  const glm::dquat& turn = mounted.body_from_camera.rotation;
  json["mount"] = {{"position_m", json_of(mounted.body_from_camera.translation_m)},
                   {"body_from_camera_wxyz", {turn.w, turn.x, turn.y, turn.z}}};
  return json;
}

Json video_of(const LabelSequence& sequence) {
  const FootageTruth& footage = sequence.footage;
  Json video{{"id", kVideoId},
             {"name", sequence.name},
             {"width", footage.size_px.width},
             {"height", footage.size_px.height},
             {"length", frame_count(footage)},
             {"fps", rounded(rate_hz(footage))}};
  if (!sequence.video.empty()) video["file_name"] = sequence.video;
  video["footage"] = {
      {"file_name", footage.video}, {"first_frame", footage.first_frame}, {"last_frame", footage.last_frame}};
  if (sequence.mounted) video["camera"] = camera_of(*sequence.mounted, sequence.camera);
  return video;
}

Json categories_of(const LabelSequence& sequence) {
  Json list = Json::array();
  for (const std::string& category : sequence.categories)
    list.push_back({{"id", list.size() + 1}, {"name", category}, {"supercategory", "intruder"}});
  return list;
}

class CocoLabels : public OneFileLabels {
 public:
  CocoLabels(TextFile file, const LabelSequence& sequence) : OneFileLabels(std::move(file), sequence) {
    sequence_.own_body.release();
    const cv::Size image = sequence.footage.size_px;
    for (const OwnBodyPart& part : own_body_parts(sequence.own_body))
      own_body_.push_back({{"bbox", json_of(part.box)},
                           {"area", part.pixels},
                           {"segmentation", rle_of(part.mask, part.box, image)},
                           {"iscrowd", 1},
                           {"own_body", true}});
  }

  Result<void> begin() override {
    return file_.put("{\n\"info\": " + json_line(info_of(sequence_)) + ",\n\"licenses\": [],\n\"videos\": [\n" +
                     json_line(video_of(sequence_)) + "\n],\n\"categories\": " + json_line(categories_of(sequence_)) +
                     ",\n\"tracks\": " + json_line(tracks()) + ",\n\"annotations\": [");
  }

  Result<void> write(const FrameTruth& truth) override {
    const int frame = truth.index - sequence_.footage.first_frame;
    const int image_id = frame + 1;
    images_ += (images_.empty() ? "\n" : ",\n") + json_line(image_of(truth, frame, image_id));
    for (const IntruderTruth& intruder : truth.intruders)
      if (is_labelled(intruder, sequence_.thresholds))
        if (const Result<void> put = put_annotation(annotation_of(intruder, image_id)); !put) return put;
    std::vector<Json> regions = own_body_;
    for (const cv::Rect& box : truth.real_aircraft) regions.push_back(real_aircraft(box));
    for (std::size_t category = 1; category <= sequence_.categories.size(); ++category)
      for (const Json& region : regions)
        if (const Result<void> put = put_annotation(region_of(region, category, image_id)); !put) return put;
    return {};
  }

  // The list of images comes last, since it is complete only after the last frame.
  Result<void> finish(const std::filesystem::path&) override {
    const Result<void> put = file_.put("\n],\n\"images\": [" + images_ + "\n]\n}\n");
    return put ? file_.close() : put;
  }

 private:
  [[nodiscard]] Json tracks() const {
    Json list = Json::array();
    for (const LabelledIntruder& intruder : sequence_.intruders)
      list.push_back({{"id", intruder.id},
                      {"category_id", category_id_of(intruder.id)},
                      {"video_id", kVideoId},
                      {"name", intruder.name}});
    return list;
  }

  [[nodiscard]] int category_id_of(int intruder_id) const { return category_index(sequence_, intruder_id) + 1; }

  [[nodiscard]] Json image_of(const FrameTruth& truth, int frame, int image_id) const {
    Json image{{"id", image_id},
               {"file_name", sequence_.images + "/" + image_name(truth.index, sequence_.image_extension)},
               {"width", sequence_.footage.size_px.width},
               {"height", sequence_.footage.size_px.height},
               {"video_id", kVideoId},
               {"frame_id", frame},
               {"footage_frame", truth.index},
               {"time_s", rounded(truth.time_s)}};
    if (sequence_.mounted) image["camera"] = sequence_.mounted->name;
    return image;
  }

  [[nodiscard]] Json annotation_of(const IntruderTruth& intruder, int image_id) const {
    Json annotation{{"image_id", image_id},
                    {"category_id", category_id_of(intruder.id)},
                    {"bbox", json_of(labelled_box(intruder, sequence_))},
                    {"area", intruder.visible_pixels}};
    if (!intruder.visible.empty())
      annotation["segmentation"] = rle_of(intruder.visible, *intruder.visible_box, sequence_.footage.size_px);
    annotation["iscrowd"] = 0;
    if (intruder.is_distractor) annotation["distractor"] = true;
    if (intruder.lights_alone) annotation["lights_alone"] = true;
    if (intruder.has_contrail) annotation["contrail"] = true;
    annotation["video_id"] = kVideoId;
    annotation["track_id"] = intruder.id;
    annotation["visible_fraction"] = rounded(intruder.visible_fraction);
    annotation["inside_fraction"] = rounded(intruder.inside_fraction);
    annotation["horizon"] = name_of(intruder.horizon);
    annotation["distance_m"] = rounded(glm::length(intruder.position_m));
    annotation["position_m"] = json_of(intruder.position_m);
    annotation["attitude_deg"] = json_of(attitude_of(intruder.world_from_body));
    if (intruder.amodal_box) annotation["amodal_bbox"] = json_of(*intruder.amodal_box);
    annotation.update(appearance_of(intruder));
    return annotation;
  }

  [[nodiscard]] Json real_aircraft(const cv::Rect& box) const {
    const cv::Mat whole(box.size(), CV_8UC1, cv::Scalar(255));
    return {{"bbox", json_of(box)},
            {"area", box.area()},
            {"segmentation", rle_of(whole, box, sequence_.footage.size_px)},
            {"iscrowd", 1},
            {"real_aircraft", true}};
  }

  [[nodiscard]] static Json region_of(const Json& part, std::size_t category_id, int image_id) {
    Json annotation{{"image_id", image_id}, {"category_id", category_id}};
    annotation.update(part);
    return annotation;
  }

  Result<void> put_annotation(const Json& annotation) {
    Json numbered{{"id", ++annotations_}};
    numbered.update(annotation);
    return file_.put((annotations_ == 1 ? "\n" : ",\n") + json_line(numbered));
  }

  std::vector<Json> own_body_;
  std::string images_;
  std::int64_t annotations_ = 0;
};

}  // namespace

Result<std::unique_ptr<LabelWriter>> open_coco(const std::filesystem::path& path, const LabelSequence& sequence) {
  return begun_file<CocoLabels>(path, sequence);
}

}  // namespace sigs

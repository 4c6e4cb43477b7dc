// SPDX-License-Identifier: MIT
#include "editor/views/inspector/inputs.h"

#include <algorithm>

#include "base/pose.h"
#include "editor/document/field_texts.h"

namespace sigs::editor {

namespace {

std::string size_text(cv::Size size_px) {
  return std::to_string(size_px.width) + " x " + std::to_string(size_px.height);
}

std::string video_text(const VideoInfo& video) {
  const double rate_hz = video.frame_rate_den > 0 ? double(video.frame_rate_num) / video.frame_rate_den : 0;
  const double length_s = video.times_s.empty() ? 0 : video.times_s.back() + (rate_hz > 0 ? 1 / rate_hz : 0);
  std::string text = size_text(video.size_px) + ", " + (video.variable_frame_rate ? "about " : "") +
                     number_text(std::round(rate_hz * 1000) / 1000, "frames/s") + ", " + video.codec + "\n" +
                     std::to_string(video.frame_count()) + " frames, " +
                     number_text(std::round(length_s * 100) / 100, "s");
  if (!video.conversion.empty()) text += "\n" + video.pixel_format + ": " + video.conversion;
  return text;
}

void draw_video(const Footage& footage, const FieldRows& rows) {
  if (footage.video) {
    note(video_text(*footage.video));
    for (const Warning& warning : footage.video->warnings) note(warning.text(), true);
  } else if (!rows.problems().contains("footage.video")) {
    note("Grey frames replace the footage.", true);
  }
}

std::string lens_text(const Camera& camera) {
  const LensParameters& lens = camera.lens.parameters();
  const std::string model = lens.model == LensModel::brown_conrady ? "Brown-Conrady" : "Kannala-Brandt (fisheye)";
  const std::string distortion =
      camera.lens.is_pinhole() ? "no distortion" : std::to_string(lens.coefficients.size()) + " coefficients";
  const double valid_deg = std::min(180.0, deg_of_rad(camera.lens.valid_angle_rad()));
  return size_text(camera.size_px) + ", " + model + ", " + distortion + "\nfocal length " +
         number_text(std::round(lens.fx * 10) / 10) + " x " + number_text(std::round(lens.fy * 10) / 10) +
         " px\nvalid to " + number_text(std::round(valid_deg * 10) / 10, "deg") + " from the axis";
}

}  // namespace

void draw_inputs(const ViewContext& context, FieldRows& rows) {
  const OpenedScene* const scene = context.shown.scene.get();
  rows.row("footage.video");
  if (scene != nullptr && scene->footage) draw_video(*scene->footage, rows);
  RowOptions last;
  last.suggested = scene != nullptr ? double(scene->draft.scene.footage.times_s.size()) - 1 : 0;
  for (const Field& field : rows.sheet().fields()) {
    if (!field.key.starts_with("footage.") || field.key == "footage.video") continue;
    rows.row(field.key, field.key == "footage.last_frame" ? last : RowOptions());
    if (field.key == "footage.calibration" && scene != nullptr && !rows.problems().contains(field.key))
      note(lens_text(scene->draft.scene.camera));
  }
}

}  // namespace sigs::editor

// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cstdio>
#include <opencv2/imgcodecs.hpp>

#include "flights/body.h"
#include "flights/sensor.h"
#include "flights/shapes.h"
#include "own_body/finding.h"
#include "own_body/measures.h"

namespace sigs::bench {

namespace {

namespace fs = std::filesystem;

const fs::path kSampleClip = fs::path(SIGS_ASSETS_DIR) / "footage/sample.mp4";
const fs::path kSampleBody = fs::path(SIGS_ASSETS_DIR) / "footage/sample_own_body.png";
const fs::path kVideos = fs::path(SIGS_TEST_DATA) / "video";

struct RealClip {
  std::string name;
  fs::path path;
  fs::path truth;  // an image; empty: not known
  bool has_body = true;
  bool is_decidable = true;
};

std::vector<RealClip> real_clips() {
  return {{.name = "sample clip", .path = kSampleClip, .truth = kSampleBody},
          {.name = "coast", .path = kVideos / "air_karma_gopro_coast.mp4", .has_body = false},
          {.name = "road", .path = kVideos / "ground_udacity_road_540p.mp4", .has_body = false},
          {.name = "bonnet", .path = kVideos / "ownbody_dashcam_bonnet_360p.mp4"},
          {.name = "tree", .path = kVideos / "opencv_tree.avi", .is_decidable = false}};
}

// A real flight without any own body, and a synthetic one drawn over it.
struct Overlay {
  std::string name;
  std::vector<flights::Part> parts;
};

std::vector<Overlay> overlays() {
  return {{"coast + tail boom", {flights::tail_boom()}},
          {"coast + nose", {flights::nose()}},
          {"coast + wing tips", {flights::wing_tip_left(), flights::wing_tip_right()}},
          {"coast + cockpit frame", {flights::windscreen()}},
          {"coast + belly and strut", {flights::strut(), flights::belly()}}};
}

Clip clip_of(const RealClip& real, cv::Size size_px) {
  Clip clip{.name = real.name, .path = real.path, .is_decidable = real.is_decidable};
  if (!real.truth.empty()) clip.own_body = cv::imread(real.truth.string(), cv::IMREAD_GRAYSCALE);
  if (!real.has_body) clip.own_body = cv::Mat::zeros(size_px, CV_8UC1);
  return clip;
}

Clip with_body(const Overlay& drawn, FrameSource& flight, int frames, const accuracy::Call& call) {
  const cv::Size size_px = flight.info().size_px;
  const flights::Body body = flights::body_of(drawn.parts, size_px, 23);
  const fs::path path = call.folder / "overlay.mp4";
  write_h264(path, size_px, frames, [&](int n) {
    const Result<Frame> frame = flight.read(n);
    if (!frame) accuracy::stop(frame.error().text());
    cv::Mat image = bgr_of(*frame);
    flights::draw_over(image, body, flights::shake_at(n, size_px, 23));
    return image;
  });
  return {.name = drawn.name, .path = path, .own_body = body.truth};
}

const char* truth_of(const Clip& clip) {
  if (!clip.is_decidable) return "still";
  if (clip.own_body.empty()) return "unknown";
  return cv::countNonZero(clip.own_body) == 0 ? "none" : "known";
}

void measure_clip(const Clip& clip, int frames, const accuracy::Call& call, accuracy::Csv& table) {
  FrameSource source = opened(clip.path);
  const Result<Frame> frame = source.read(std::min(frames, source.info().frame_count()) / 2);
  if (!frame) accuracy::stop(frame.error().text());
  for (const OwnBodyMethod method : {OwnBodyMethod::paper, OwnBodyMethod::stable}) {
    const Finding finding = found_in(clip, with_method(method, frames));
    const bool truth_known = !clip.own_body.empty() || !clip.is_decidable;
    const std::string value = truth_known ? std::to_string(agreement(finding, clip)) : "";
    table.row(clip.name, name_of(method), value, 100 * finding.body.share, truth_of(clip),
              finding.cannot.empty() ? "mask" : "cannot tell");
    std::printf("%-26s %-6s IoU %s, %.2f %% masked %s\n", clip.name.c_str(), name_of(method), value.c_str(),
                100 * finding.body.share, finding.cannot.c_str());
    std::fflush(stdout);
    if (!finding.cannot.empty()) continue;
    const std::string file = clip.name + " " + name_of(method);
    write_image(call.folder / "real" / (file + ".jpg"), overlay(bgr_of(*frame), finding.body.mask, clip.own_body));
    write_image(call.folder / "real" / (file + " mask.png"), finding.body.mask);
  }
}

}  // namespace

void measure_real_clips(const accuracy::Call& call) {
  accuracy::Csv table(call.folder / "real.csv", "clip,method,iou,found_percent,truth,said");
  const int frames = call.quick ? 80 : 1500;
  for (const RealClip& real : real_clips()) {
    if (!fs::exists(real.path)) {
      std::printf("%s: not there, left out\n", real.path.string().c_str());
      continue;
    }
    measure_clip(clip_of(real, opened(real.path).info().size_px), frames, call, table);
  }
  const fs::path coast = kVideos / "air_karma_gopro_coast.mp4";
  if (!fs::exists(coast)) return;
  FrameSource flight = opened(coast);
  for (const Overlay& drawn : overlays()) {
    const Clip clip = with_body(drawn, flight, std::min(frames, flight.info().frame_count()), call);
    measure_clip(clip, frames, call, table);
    fs::remove(clip.path);
  }
}

}  // namespace sigs::bench

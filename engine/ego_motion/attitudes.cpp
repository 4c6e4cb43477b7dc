// SPDX-License-Identifier: MIT
#include "ego_motion/attitudes.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <thread>
#include <utility>

#include "base/pose.h"
#include "base/threads.h"
#include "ego_motion/bundle.h"
#include "plot/plot.h"

namespace sigs {

namespace {

int cores() {
  return std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
}

// Key frames of a run of linked frames: each settings.key_every-th and the last.
std::vector<int> keys_of(int first, int last, int every) {
  std::vector<int> keys;
  for (int f = first; f < last; f += every) keys.push_back(f);
  if (keys.size() > 1 && last - keys.back() < every / 2) keys.pop_back();
  keys.push_back(last);
  return keys;
}

glm::dmat3 turned(const glm::dmat3& covariance, const glm::dquat& to_from_from) {
  const glm::dmat3 r = glm::mat3_cast(to_from_from);
  return r * covariance * glm::transpose(r);
}

// One run of frames that are linked to each other.
class Run {
 public:
  Run(std::span<const FrameRays> frames, std::span<const double> times_s,
      std::span<const std::optional<RotationFit>> steps, double pixel_rad, const EgoMotionSettings& settings,
      double readout_s, const StepControl& control)
      : frames_(frames),
        times_s_(times_s),
        steps_(steps),
        pixel_rad_(pixel_rad),
        settings_(settings),
        readout_s_(readout_s),
        control_(control) {}

  // Rotations against the run's first frame.
  void solve(std::span<FrameRotation> out) {
    chain(out);
    if (out.size() < 2) return;
    keys_ = keys_of(0, static_cast<int>(out.size()) - 1, settings_.key_every);
    const std::size_t stride = static_cast<std::size_t>(settings_.window_keys - settings_.window_overlap);
    for (std::size_t begin = 0; !control_.is_cancelled(); begin += stride) {
      const std::size_t end = std::min(keys_.size(), begin + static_cast<std::size_t>(settings_.window_keys));
      solve_window(begin, end, out);
      control_.report(static_cast<double>(end) / static_cast<double>(keys_.size()));
      if (end == keys_.size()) break;
    }
  }

 private:
  // First values, from frame to frame.
  void chain(std::span<FrameRotation> out) {
    for (std::size_t i = 1; i < out.size(); ++i)
      out[i].start_from_camera =
          glm::normalize(out[i - 1].start_from_camera * glm::conjugate(steps_[i]->after_from_before));
    chained_.clear();
    for (const FrameRotation& r : out) chained_.push_back(r.start_from_camera);
  }

  void solve_window(std::size_t begin, std::size_t end, std::span<FrameRotation> out) {
    const std::span<const int> keys = std::span(keys_).subspan(begin, end - begin);
    const KeyFrames solved = adjusted_keys(frames_, times_s_, chained_, keys, pixel_rad_, control_.cancel);
    if (control_.is_cancelled()) return;
    // Frames before the middle of the overlap keep what the window before says of them.
    const int from = begin == 0 ? 0 : keys[static_cast<std::size_t>(settings_.window_overlap) / 2];
    const auto start = static_cast<std::size_t>(from);
    const glm::dquat world_from_start = out[start].start_from_camera;
    const glm::dmat3 start_covariance = out[start].covariance;
    const FrameRotation at_start = located(solved, keys, from);
    const glm::dquat shift = glm::normalize(world_from_start * glm::conjugate(at_start.start_from_camera));
    const int last = keys.back();
    parallel_for(last - from + 1, cores(), [&](int i) {
      const int f = from + i;
      if ((i == 0 && begin > 0) || control_.is_cancelled()) return;
      FrameRotation r = located(solved, keys, f);
      r.start_from_camera = glm::normalize(shift * r.start_from_camera);
      r.covariance += turned(start_covariance, glm::conjugate(r.start_from_camera) * world_from_start);
      r.is_linked = f > 0;
      out[static_cast<std::size_t>(f)] = r;
    });
  }

  // The rotation of any frame of the window against the window's first key frame.
  [[nodiscard]] FrameRotation located(const KeyFrames& solved, std::span<const int> keys, int f) const {
    const auto after = std::upper_bound(keys.begin(), keys.end() - 1, f);
    const auto b = static_cast<std::size_t>(after - keys.begin());
    const std::size_t a = b - 1;
    const auto index = [](int frame) { return static_cast<std::size_t>(frame); };
    const double share =
        (times_s_[index(f)] - times_s_[index(keys[a])]) / (times_s_[index(keys[b])] - times_s_[index(keys[a])]);
    const BundleFrame& before = solved.frames[a];
    const BundleFrame& next = solved.frames[b];
    BundleFrame guess;
    // The turn since the key frame as the chain has it, and what the chain misses by at the next key frame in parts.
    const glm::dquat ab = glm::conjugate(chained_[index(keys[a])]) * chained_[index(keys[b])];
    const glm::dquat af = glm::conjugate(chained_[index(keys[a])]) * chained_[index(f)];
    const glm::dvec3 gap = vector_of(glm::conjugate(before.world_from_camera * ab) * next.world_from_camera);
    guess.world_from_camera = before.world_from_camera * af * turn_of(share * gap);
    guess.position = (1 - share) * before.position + share * next.position;
    const LocatedFrame found = located_frame(solved, frames_[index(f)], guess, readout_s_);
    FrameRotation r;
    r.start_from_camera = found.world_from_camera;
    r.own_covariance = found.covariance;
    r.covariance = (1 - share) * solved.covariances[a] + share * solved.covariances[b] + found.covariance;
    r.features_used = found.features_used;
    r.has_ground = solved.ground.has_value();
    r.readout_turn = found.readout_turn;
    return r;
  }

  std::span<const FrameRays> frames_;
  std::span<const double> times_s_;
  std::span<const std::optional<RotationFit>> steps_;
  double pixel_rad_;
  const EgoMotionSettings& settings_;
  double readout_s_;
  const StepControl& control_;
  std::vector<glm::dquat> chained_;
  std::vector<int> keys_;
};

constexpr double kPanelHeight = 270;
constexpr PlotColor kLine{20, 80, 170}, kBand{170, 210, 240}, kLost{200, 200, 200};

// One angle with its standard deviation. Angles that pass 180 degrees go on beyond it.
Plot angle_plot(const EgoMotion& motion, const std::string& name, int axis, double Attitude::*angle_rad) {
  PlotSeries lost{.title = "nothing is known", .kind = SeriesKind::areas, .color = kLost};
  PlotSeries band{.title = "2 standard deviations since frame 0", .kind = SeriesKind::areas, .color = kBand};
  PlotSeries line{.title = name, .runs = {{}}, .color = kLine};
  std::vector<PlotPoint>& points = line.runs.front();
  for (const EgoFrame& frame : motion.frames) {
    const double deg = deg_of_rad(attitude_of(frame.world_from_camera).*angle_rad);
    const double turns = points.empty() ? 0 : std::round((points.back().y - deg) / 360);
    points.push_back({frame.time_s, deg + 360 * turns});
  }
  const PlotSpan range = range_of({line}, &PlotPoint::y, 0.08);
  for (std::size_t k = 0; k < points.size(); ++k) {  // each to the next frame
    const double next_s = points[std::min(k + 1, points.size() - 1)].x;
    const double sd_deg = deg_of_rad(motion.frames[k].sd_rad[axis]);
    if (sd_deg < deg_of_rad(kUnknownRotation_rad) / 2)
      band.runs.push_back({{points[k].x, points[k].y + 2 * sd_deg}, {next_s, points[k].y - 2 * sd_deg}});
    else
      lost.runs.push_back({{points[k].x, range.first}, {next_s, range.last}});
  }
  return {.title = name + ", degrees",
          .x_label = "time, s",
          .x_range = {0, std::max(points.back().x, 1e-3)},
          .y_range = range,
          .series = {std::move(lost), std::move(band), std::move(line)},
          .height = kPanelHeight};
}

}  // namespace

FrameRays unrolled(const FrameRays& frame, const ReadoutTurn& turn, double readout_s) {
  FrameRays rays = frame;
  for (RayObservation& o : rays) o.ray = turn_of(turn.after(readout_s * o.row)) * o.ray;
  return rays;
}

std::vector<std::optional<RotationFit>> steps_between(std::span<const FrameRays> frames, double pixel_rad,
                                                      const EgoMotionSettings& settings, CancelFlag cancel) {
  std::vector<std::optional<RotationFit>> steps(frames.size());
  const RotationFitSettings fit{.inlier_rad = 2 * pixel_rad, .min_inliers = settings.min_features};
  parallel_for(static_cast<int>(frames.size()) - 1, cores(), [&](int i) {
    const auto k = static_cast<std::size_t>(i) + 1;
    if (is_cancelled(cancel)) return;
    steps[k] = fitted_rotation(common_rays(frames[k - 1], frames[k]), fit);
  });
  return steps;
}

std::vector<FrameRotation> rotations_of(std::span<const FrameRays> frames, std::span<const double> times_s,
                                        double pixel_rad, const EgoMotionSettings& settings, double readout_s,
                                        const StepControl& control) {
  const std::vector<std::optional<RotationFit>> steps = steps_between(frames, pixel_rad, settings, control.cancel);
  std::vector<FrameRotation> all(frames.size());
  for (std::size_t first = 0; first < frames.size() && !control.is_cancelled();) {
    std::size_t end = first + 1;
    while (end < frames.size() && steps[end]) ++end;
    const std::size_t count = end - first;
    const std::span<FrameRotation> out = std::span(all).subspan(first, count);
    const StepControl of_run{.cancel = control.cancel, .progress = [&](double share) {
                               const double done = static_cast<double>(first) + share * static_cast<double>(count);
                               control.report(done / static_cast<double>(frames.size()));
                             }};
    Run(frames.subspan(first, count), times_s.subspan(first, count), std::span(steps).subspan(first, count), pixel_rad,
        settings, readout_s, of_run)
        .solve(out);
    if (first > 0) {
      const FrameRotation& before = all[first - 1];
      const glm::dquat world_from_run = before.start_from_camera;
      for (FrameRotation& r : out) {
        r.covariance += turned(before.covariance, glm::conjugate(r.start_from_camera));
        r.start_from_camera = glm::normalize(world_from_run * r.start_from_camera);
      }
    }
    first = end;
  }
  return all;
}

std::vector<double> drift_deviations(std::span<const FrameRotation> rotations, std::span<const double> times_s) {
  constexpr double kClouds_radps = 0.01;
  const auto may_drift = [&](std::size_t k) { return rotations[k].is_linked && !rotations[k].has_ground; };
  std::vector<double> deviations(rotations.size(), 0);
  for (std::size_t k = 1; k < rotations.size();) {
    if (!may_drift(k)) {
      deviations[k] = deviations[k - 1];
      ++k;
      continue;
    }
    const std::size_t before = k - 1;
    while (k < rotations.size() && may_drift(k)) ++k;
    const std::size_t last = k - 1;
    const double seen_rad =
        glm::length(vector_of(glm::conjugate(rotations[before].start_from_camera) * rotations[last].start_from_camera));
    const double length_s = times_s[last] - times_s[before];
    const double rate_radps = std::min(kClouds_radps, length_s > 0 ? seen_rad / length_s : kClouds_radps);
    for (std::size_t i = before + 1; i <= last; ++i)
      deviations[i] = deviations[before] + rate_radps * (times_s[i] - times_s[before]);
  }
  return deviations;
}

cv::Mat attitude_plot(const EgoMotion& motion) {
  return image_of({angle_plot(motion, "roll", 0, &Attitude::roll_rad),
                   angle_plot(motion, "pitch", 1, &Attitude::pitch_rad),
                   angle_plot(motion, "yaw", 2, &Attitude::yaw_rad)});
}

}  // namespace sigs

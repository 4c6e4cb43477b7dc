// SPDX-License-Identifier: MIT
#include "world_lock/slip.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "scene/scene_at.h"
#include "world_lock/background_point.h"
#include "world_lock/places.h"

namespace sigs::bench {

namespace {

constexpr int kPlaces = 3;
constexpr int kNoPlaceStep = 5;  // frames until it is tried again where there was no place

// The intruders of one start: scenes by knowledge, in each of them an intruder at each distance for each place.
class Stretch {
 public:
  Stretch(const Clip& clip, const std::vector<CameraKnowledge>& cameras, int start,
          const std::vector<cv::Point>& places, std::span<const double> distances_m)
      : clip_(clip), start_(start), distances_(distances_m.size()) {
    std::vector<Hovering> intruders;
    for (const cv::Point& place : places)
      for (const double distance_m : distances_m) intruders.push_back({.pixel = place, .distance_m = distance_m});
    for (const CameraKnowledge& camera : cameras) scenes_.push_back(scene_with(clip, camera, start, intruders));
    for (const cv::Point& place : places) points_.emplace_back(BackgroundPoint(clip, start, place));
    for (const cv::Point& place : places) at_.emplace_back(place);
  }

  // Mean displacement of the points since the start, as far as each was followed.
  [[nodiscard]] cv::Point2d shift_px() const { return shift_px_; }

  // The next frame. False once no point can be followed any more.
  bool step(int frame, const Pyramid& before, const Pyramid& after, SlipRun& run) {
    bool any = false;
    for (std::size_t place = 0; place < points_.size(); ++place) {
      if (!points_[place]) continue;
      const std::optional<BackgroundStep> background = points_[place]->next(before, after);
      if (!background || !add(place, frame, *background, run)) points_[place].reset();
      if (points_[place]) shift_px_ += background->step.px / static_cast<double>(points_.size());
      any = any || points_[place].has_value();
    }
    return any;
  }

 private:
  bool add(std::size_t place, int frame, const BackgroundStep& background, SlipRun& run) {
    const double since_s = time_s(frame) - time_s(start_);
    SlipSample sample{.start = start_,
                      .place = static_cast<int>(place),
                      .frame = frame,
                      .since_s = since_s,
                      .corners = background.corners,
                      .reference_sd_px = background.step.sd_px,
                      .growth = background.growth,
                      .start_px = at_[place],
                      .background = background.at};
    for (const Scene& scene : scenes_) {
      const std::size_t first = place * distances_;
      const auto at_start = pixel_of(scene, first, start_), before = pixel_of(scene, first, frame - 1),
                 now = pixel_of(scene, first, frame);
      if (!at_start || !before || !now) return false;
      sample.step_px.push_back(*now - *before - background.step.px);
      // Where the intruder was put and where its truth says it was agree but for the rows' times.
      sample.offset_px.push_back((*now - *at_start) - (background.at - at_[place]));
      for (std::size_t i = 1; i < distances_; ++i)
        run.distances_differ_px =
            std::max(run.distances_differ_px, cv::norm(pixel_of(scene, first + i, frame).value_or(*now) - *now));
    }
    run.samples.push_back(std::move(sample));
    return true;
  }

  [[nodiscard]] double time_s(int frame) const { return clip_.shape.times_s[static_cast<std::size_t>(frame)]; }

  const Clip& clip_;
  int start_;
  std::size_t distances_;
  std::vector<Scene> scenes_;
  std::vector<std::optional<BackgroundPoint>> points_;
  std::vector<cv::Point2d> at_;
  cv::Point2d shift_px_;
};

}  // namespace

SlipRun slip_of(const Clip& clip, const std::vector<CameraKnowledge>& cameras, std::span<const double> distances_m) {
  SlipRun run;
  cv::Point2d shift_px;
  const std::vector<double>& times_s = clip.shape.times_s;
  for (int start = 0; start + 1 < clip.frame_count();) {
    const std::vector<cv::Point> places = places_in(clip, start, kPlaces, cv::Point(shift_px));
    if (places.empty()) {
      start += kNoPlaceStep;
      continue;
    }
    Stretch stretch(clip, cameras, start, places, distances_m);
    int frame = start;
    Pyramid before = pyramid_of(clip.luma[static_cast<std::size_t>(frame)]);
    bool goes_on = true;
    while (goes_on && frame + 1 < clip.frame_count() &&
           times_s[static_cast<std::size_t>(frame) + 1] - times_s[static_cast<std::size_t>(start)] <= kLongest_s) {
      Pyramid after = pyramid_of(clip.luma[static_cast<std::size_t>(frame) + 1]);
      goes_on = stretch.step(++frame, before, after, run);
      before = std::move(after);
    }
    start = frame;
    shift_px += stretch.shift_px();
  }
  return run;
}

std::vector<std::vector<cv::Point2d>> offsets_beyond_parallax(const SlipRun& run) {
  constexpr double kMinGrowth = 0.005;
  struct Fit {
    cv::Point2d sum;
    double weight = 0, most = 0;
  };
  std::map<int, Fit> fits;  // by start
  for (const SlipSample& sample : run.samples) {
    Fit& fit = fits[sample.start];
    const double grown = sample.growth - 1;
    fit.sum += grown * (sample.offset_px.back() + grown * sample.start_px);
    fit.weight += grown * grown;
    fit.most = std::max(fit.most, std::abs(grown));
  }
  std::vector<std::vector<cv::Point2d>> left;
  for (const SlipSample& sample : run.samples) {
    const Fit& fit = fits[sample.start];
    left.push_back(sample.offset_px);
    if (fit.most < kMinGrowth) continue;
    const cv::Point2d flight_px = fit.sum / fit.weight;
    for (cv::Point2d& offset : left.back()) offset += (sample.growth - 1) * (sample.start_px - flight_px);
  }
  return left;
}

std::vector<std::vector<cv::Point2d>> trembling(const SlipRun& run) {
  constexpr double kHalf_s = 0.5;
  std::map<std::pair<int, int>, std::vector<std::size_t>> points;  // samples by start and place, in order of time
  for (std::size_t i = 0; i < run.samples.size(); ++i)
    points[{run.samples[i].start, run.samples[i].place}].push_back(i);
  std::vector<std::vector<cv::Point2d>> left(run.samples.size());
  for (const auto& [point, samples] : points)
    for (const std::size_t i : samples) {
      const SlipSample& sample = run.samples[i];
      left[i] = sample.step_px;
      std::vector<cv::Point2d> mean(sample.step_px.size());
      double count = 0;
      for (const std::size_t other : samples) {
        if (std::abs(run.samples[other].since_s - sample.since_s) > kHalf_s) continue;
        ++count;
        for (std::size_t k = 0; k < mean.size(); ++k) mean[k] += run.samples[other].step_px[k];
      }
      for (std::size_t k = 0; k < mean.size(); ++k) left[i][k] -= mean[k] / count;
    }
  return left;
}

}  // namespace sigs::bench

// SPDX-License-Identifier: MIT
#include "calibration/rough_calibration.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/pose.h"
#include "calibration/rough_lens.h"
#include "calibration/rough_motion.h"

namespace sigs {

namespace {

constexpr double kAgree = 3;        // standard deviations
constexpr double kLinesFactor = 2;  // lines that bend themselves have that in common
constexpr double kLinesLeastSd = 0.02;

DistortionPrior prior_by(const LinesAnswer& lines) {
  return {.mean = lines.distortion, .sd = std::max(kLinesLeastSd, kLinesFactor * lines.sd)};
}

bool overlap(const RoughFit& a, const RoughFit& b) {
  return a.field_low_rad <= b.field_high_rad && b.field_low_rad <= a.field_high_rad;
}

std::string field_text(const RoughFit& fit) {
  return fmt::format("{:.1f} degrees ({:.1f} to {:.1f})", deg_of_rad(fit.lens.horizontal_field_rad()),
                     deg_of_rad(fit.field_low_rad), deg_of_rad(fit.field_high_rad));
}

RoughFit given_fit(const RoughLens& lens, double distortion_sd) {
  return {.lens = lens,
          .distortion_sd = distortion_sd,
          .field_low_rad = lens.horizontal_field_rad(),
          .field_high_rad = lens.horizontal_field_rad()};
}

class Search {
 public:
  Search(FrameSource& footage, const Track* log, const std::filesystem::path& log_file, const RoughSettings& settings,
         const RoughControl& control)
      : footage_(footage), log_(log), log_file_(log_file), settings_(settings), control_(control) {}

  Result<RoughCalibration> run() {
    LinesRoad lines;
    Result<PixelTracks> tracks = tracked_pixels(
        footage_, std::max(2, settings_.max_frames),
        [&lines](int number, const cv::Mat& luma) { lines.add(number, luma); }, control_);
    if (!tracks) return fail(tracks.error());
    found_.frames = static_cast<int>(tracks->frames.size());
    found_.lines = lines.answer();
    search(*tracks);
    if (is_cancelled(control_.cancel)) return fail("", "interrupted; nothing was written", ErrorKind::interrupted);
    if (const Result<void> chosen = choose(tracks->size_px); !chosen) return fail(chosen.error());
    compare();
    return std::move(found_);
  }

 private:
  [[nodiscard]] std::string path() const { return footage_.info().path.string(); }
  void warn(std::string what) { found_.warnings.push_back({path(), std::move(what)}); }

  // Each method first without what the lines say; then with it, where both agree.
  void search(const PixelTracks& tracks) {
    const DistortionPrior any;
    if (log_ == nullptr)
      found_.gyro.answer.reason = "there is no log with angular rates";
    else
      found_.gyro = lens_by_gyro(tracks, *log_, any, control_.cancel);
    if (agrees(found_.gyro.answer, "gyroscope"))
      found_.gyro = lens_by_gyro(tracks, *log_, prior_by(found_.lines), control_.cancel);
    if (is_cancelled(control_.cancel)) return;
    found_.turn = lens_by_turn(tracks, any);
    if (is_cancelled(control_.cancel)) return;
    if (agrees(found_.turn, "turn")) found_.turn = lens_by_turn(tracks, prior_by(found_.lines));
    const DistortionPrior prior = found_.lines.is_certain ? prior_by(found_.lines) : any;
    found_.stated = stated_lens(footage_.info().path, tracks.size_px, prior);
    if (!found_.stated.fit && !log_file_.empty()) found_.stated = stated_lens(log_file_, tracks.size_px, prior);
  }

  // Whether the lines say the same of the distortion; warns where they do not.
  bool agrees(const RoughAnswer& answer, const char* method) {
    if (!answer.fit || !found_.lines.is_certain) return false;
    const double apart = std::abs(answer.fit->lens.distortion - found_.lines.distortion);
    if (apart < kAgree * std::hypot(answer.fit->distortion_sd, prior_by(found_.lines).sd)) return true;
    warn(fmt::format("straight edges show a distortion of {:.2f}, the {} {:.2f}: the edges are not used",
                     found_.lines.distortion, method, answer.fit->lens.distortion));
    return false;
  }

  Result<void> choose(cv::Size size_px) {
    if (settings_.given_field_rad) {
      const double distortion = found_.lines.is_certain ? found_.lines.distortion : 0;
      const auto lens = rough_lens_of_field(size_px, *settings_.given_field_rad, distortion);
      if (!lens) return fail("--fov", "is no field of view of a lens", ErrorKind::usage);
      take(RoughSource::given, given_fit(*lens, found_.lines.is_certain ? found_.lines.sd : DistortionPrior{}.sd));
    } else if (found_.gyro.answer.fit) {
      take(RoughSource::gyroscope, *found_.gyro.answer.fit);
    } else if (found_.turn.fit) {
      take(RoughSource::turn, *found_.turn.fit);
    } else if (found_.stated.fit) {
      take(RoughSource::stated, *found_.stated.fit);
    } else {
      const std::string lines = found_.lines.is_certain ? fmt::format("show a distortion of {:.2f}, no field of view",
                                                                      found_.lines.distortion)
                                                        : found_.lines.reason;
      return fail(path(),
                  fmt::format("shows no field of view. By the gyroscope: {}. By turns: {}. By straight edges: {}. "
                              "By what the file states: {}. Give the field of view (--fov), footage in which "
                              "the camera turns at one place, or a board (--board)",
                              found_.gyro.answer.reason, found_.turn.reason, lines, found_.stated.reason));
    }
    return {};
  }

  void take(RoughSource source, const RoughFit& fit) {
    found_.source = source;
    found_.fit = fit;
    found_.distortion_by_lines =
        found_.lines.is_certain && std::abs(fit.lens.distortion - found_.lines.distortion) < kAgree * found_.lines.sd;
  }

  // Says where methods disagree. Two that measure and disagree make the result as uncertain as both together.
  void compare() {
    const VideoInfo& info = footage_.info();
    if (info.pixel_aspect_num != info.pixel_aspect_den)
      warn(fmt::format("has pixels of {}:{}, which are not square: the calibration takes them to be",
                       info.pixel_aspect_num, info.pixel_aspect_den));
    const auto& gyro = found_.gyro.answer.fit;
    if (gyro && found_.turn.fit && !overlap(*gyro, *found_.turn.fit)) {
      warn(fmt::format("the gyroscope shows a field of view of {}, turns of the camera {}: neither is certain",
                       field_text(*gyro), field_text(*found_.turn.fit)));
      if (found_.source == RoughSource::gyroscope) {
        found_.fit.field_low_rad = std::min(gyro->field_low_rad, found_.turn.fit->field_low_rad);
        found_.fit.field_high_rad = std::max(gyro->field_high_rad, found_.turn.fit->field_high_rad);
      }
    }
    compare_with_stated();
    if (found_.source != RoughSource::given) return;
    for (const auto& [fit, source] : {std::pair(gyro, RoughSource::gyroscope), {found_.turn.fit, RoughSource::turn}})
      if (fit && !overlap(*fit, found_.fit))
        warn(fmt::format("--fov says {:.1f} degrees, {} shows {}", deg_of_rad(found_.fit.lens.horizontal_field_rad()),
                         name_of(source), field_text(*fit)));
  }

  void compare_with_stated() {
    const auto& stated = found_.stated.fit;
    if (!stated || found_.source == RoughSource::stated || overlap(*stated, found_.fit)) return;
    warn(fmt::format("the file states a field of view of {}, {} shows {}: cropped, zoomed or stabilised?",
                     field_text(*stated), name_of(found_.source), field_text(found_.fit)));
  }

  FrameSource& footage_;
  const Track* log_;
  const std::filesystem::path& log_file_;
  RoughSettings settings_;
  const RoughControl& control_;
  RoughCalibration found_;
};

}  // namespace

const char* name_of(RoughSource source) {
  switch (source) {
    case RoughSource::given:
      return "the field of view given";
    case RoughSource::gyroscope:
      return "the gyroscope";
    case RoughSource::turn:
      return "turns of the camera";
    case RoughSource::stated:
      return "what the file states";
  }
  return "";
}

Result<RoughCalibration> rough_calibration(FrameSource& footage, const Track* log,
                                           const std::filesystem::path& log_file, const RoughSettings& settings,
                                           const RoughControl& control) {
  return Search(footage, log, log_file, settings, control).run();
}

}  // namespace sigs

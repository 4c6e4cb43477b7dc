// SPDX-License-Identifier: MIT
#include "autocalibration/autocalibration.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/pose.h"

namespace sigs {

namespace {

bool overlap(const LensEstimate& a, const LensEstimate& b) {
  return a.field_low_rad <= b.field_high_rad && b.field_low_rad <= a.field_high_rad;
}

std::string field_text(const LensEstimate& fit) {
  return fmt::format("{:.1f} degrees ({:.1f} to {:.1f})", deg_of_rad(fit.lens.horizontal_field_rad()),
                     deg_of_rad(fit.field_low_rad), deg_of_rad(fit.field_high_rad));
}

LensEstimate given_fit(const DivisionLens& lens, double distortion_sd) {
  return {.lens = lens,
          .distortion_sd = distortion_sd,
          .field_low_rad = lens.horizontal_field_rad(),
          .field_high_rad = lens.horizontal_field_rad()};
}

class Search {
 public:
  Search(FrameSource& footage, const Track* log, const std::filesystem::path& log_file,
         const AutocalibrationSettings& settings, const AutocalibrationControl& control)
      : footage_(footage), log_(log), log_file_(log_file), settings_(settings), control_(control) {}

  Result<Autocalibration> run() {
    const Result<PixelTracks> tracks = tracked_pixels(footage_, std::max(2, settings_.max_frames), control_);
    if (!tracks) return fail(tracks.error());
    found_.frames = static_cast<int>(tracks->frames.size());
    search(*tracks);
    if (is_cancelled(control_.cancel)) return fail("", "interrupted; nothing was written", ErrorKind::interrupted);
    if (const Result<void> chosen = choose(tracks->size_px); !chosen) return fail(chosen.error());
    compare();
    return std::move(found_);
  }

 private:
  [[nodiscard]] std::string path() const { return footage_.info().path.string(); }
  void warn(std::string what) { found_.warnings.push_back({path(), std::move(what)}); }

  void search(const PixelTracks& tracks) {
    const DistortionPrior prior;
    if (log_ == nullptr)
      found_.gyro.answer.reason = "there is no log with angular rates";
    else
      found_.gyro = lens_by_gyro(tracks, *log_, prior, control_.cancel);
    if (is_cancelled(control_.cancel)) return;
    found_.turn = lens_by_turn(tracks, prior);
    found_.stated = stated_lens(footage_.info().path, tracks.size_px, prior);
    if (!found_.stated.fit && !log_file_.empty()) found_.stated = stated_lens(log_file_, tracks.size_px, prior);
  }

  Result<void> choose(cv::Size size_px) {
    if (settings_.given_field_rad) {
      const auto lens = division_lens_of_field(size_px, *settings_.given_field_rad, 0);
      if (!lens) return fail("--fov", "is no field of view of a lens", ErrorKind::usage);
      take(AutocalibrationSource::given, given_fit(*lens, DistortionPrior{}.sd));
    } else if (found_.gyro.answer.fit) {
      take(AutocalibrationSource::gyroscope, *found_.gyro.answer.fit);
    } else if (found_.turn.fit) {
      take(AutocalibrationSource::turn, *found_.turn.fit);
    } else if (found_.stated.fit) {
      take(AutocalibrationSource::stated, *found_.stated.fit);
    } else {
      return fail(
          path(),
          fmt::format("shows no field of view. By the gyroscope: {}. By turns: {}. By what the file states: {}. "
                      "Give the field of view (--fov), footage in which the camera turns at one place, or a "
                      "board (--board)",
                      found_.gyro.answer.reason, found_.turn.reason, found_.stated.reason));
    }
    return {};
  }

  void take(AutocalibrationSource source, const LensEstimate& fit) {
    found_.source = source;
    found_.fit = fit;
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
      if (found_.source == AutocalibrationSource::gyroscope) {
        found_.fit.field_low_rad = std::min(gyro->field_low_rad, found_.turn.fit->field_low_rad);
        found_.fit.field_high_rad = std::max(gyro->field_high_rad, found_.turn.fit->field_high_rad);
      }
    }
    compare_with_stated();
    if (found_.source != AutocalibrationSource::given) return;
    for (const auto& [fit, source] :
         {std::pair(gyro, AutocalibrationSource::gyroscope), {found_.turn.fit, AutocalibrationSource::turn}})
      if (fit && !overlap(*fit, found_.fit))
        warn(fmt::format("--fov says {:.1f} degrees, {} shows {}", deg_of_rad(found_.fit.lens.horizontal_field_rad()),
                         name_of(source), field_text(*fit)));
  }

  void compare_with_stated() {
    const auto& stated = found_.stated.fit;
    if (!stated || found_.source == AutocalibrationSource::stated || overlap(*stated, found_.fit)) return;
    warn(fmt::format("the file states a field of view of {}, {} shows {}: cropped, zoomed or stabilised?",
                     field_text(*stated), name_of(found_.source), field_text(found_.fit)));
  }

  FrameSource& footage_;
  const Track* log_;
  const std::filesystem::path& log_file_;
  AutocalibrationSettings settings_;
  const AutocalibrationControl& control_;
  Autocalibration found_;
};

}  // namespace

const char* name_of(AutocalibrationSource source) {
  switch (source) {
    case AutocalibrationSource::given:
      return "the field of view given";
    case AutocalibrationSource::gyroscope:
      return "the gyroscope";
    case AutocalibrationSource::turn:
      return "turns of the camera";
    case AutocalibrationSource::stated:
      return "what the file states";
  }
  return "";
}

Result<Autocalibration> autocalibrated(FrameSource& footage, const Track* log, const std::filesystem::path& log_file,
                                       const AutocalibrationSettings& settings, const AutocalibrationControl& control) {
  return Search(footage, log, log_file, settings, control).run();
}

}  // namespace sigs

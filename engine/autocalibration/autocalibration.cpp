// SPDX-License-Identifier: MIT
#include "autocalibration/autocalibration.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/core.hpp>
#include <string>
#include <utility>
#include <vector>

#include "base/json.h"
#include "base/pose.h"
#include "plot/plot.h"

namespace sigs {

namespace {

struct SourceWords {
  const char* name;
  const char* key;  // in JSON
};

const SourceWords& words_of(AutocalibrationSource source) {
  static constexpr std::array<SourceWords, 4> kWords{{{"the field of view given", "given"},
                                                      {"the gyroscope", "gyroscope"},
                                                      {"turns of the camera", "turn"},
                                                      {"what the file states", "stated"}}};
  return kWords.at(static_cast<std::size_t>(source));
}

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
    if (const Result<void> goes_on = check_interrupt(control_.cancel); !goes_on) return fail(goes_on.error());
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
  return words_of(source).name;
}

Result<Autocalibration> autocalibrated(FrameSource& footage, const Track* log, const std::filesystem::path& log_file,
                                       const AutocalibrationSettings& settings, const AutocalibrationControl& control) {
  return Search(footage, log, log_file, settings, control).run();
}

namespace {

Json fit_json(const LensEstimate& fit) {
  return {{"horizontal_field_deg", deg_of_rad(fit.lens.horizontal_field_rad())},
          {"horizontal_field_low_deg", deg_of_rad(fit.field_low_rad)},
          {"horizontal_field_high_deg", deg_of_rad(fit.field_high_rad)},
          {"focal_px", fit.lens.focal_px},
          {"distortion", fit.lens.distortion},
          {"distortion_sd", fit.distortion_sd}};
}

Json answer_json(const LensAnswer& answer) {
  Json json = answer.fit ? fit_json(*answer.fit) : Json::object();
  json["used"] = answer.fit.has_value();
  json["remark"] = answer.reason;
  if (answer.fit && answer.fit->parts > 0) {
    json["independent_parts"] = answer.fit->parts;
    json["residual_px"] = answer.fit->residual_px;
  }
  return json;
}

Json gyro_json(const GyroAnswer& gyro) {
  Json json = answer_json(gyro.answer);
  if (gyro.source.empty()) return json;
  json["rates"] = gyro.source;
  json["correlation"] = gyro.correlation;
  json["offset_s"] = gyro.offset_s;
  json["offset_sd_s"] = gyro.offset_sd_s;
  return json;
}

}  // namespace

Result<CalibrationText> calibration_text(const Autocalibration& found) {
  Result<LensParameters> lens = parameters_of(found.fit.lens);
  if (!lens) return fail(lens.error());
  return CalibrationText{
      .lens = *std::move(lens),
      .size_px = found.fit.lens.size_px,
      .comment = "A rough calibration, without a board: " + summary_of(found),
      .numbers = {{"rough_calibration", 1},
                  {"horizontal_field_deg", deg_of_rad(found.fit.lens.horizontal_field_rad())},
                  {"horizontal_field_low_deg", deg_of_rad(found.fit.field_low_rad)},
                  {"horizontal_field_high_deg", deg_of_rad(found.fit.field_high_rad)},
                  {"radial_distortion_sd", found.fit.distortion_sd}},
  };
}

std::string summary_of(const Autocalibration& found) {
  const LensEstimate& fit = found.fit;
  const double field_deg = deg_of_rad(fit.lens.horizontal_field_rad());
  const std::string limits =
      fit.field_low_rad < fit.field_high_rad
          ? fmt::format(" (95 %: {:.1f} to {:.1f})", deg_of_rad(fit.field_low_rad), deg_of_rad(fit.field_high_rad))
          : std::string();
  return fmt::format(
      "field of view {:.1f} degrees across{}, focal length {:.1f} px, by {}; distortion {:.3f} +- {:.3f}", field_deg,
      limits, fit.lens.focal_px, name_of(found.source), fit.lens.distortion, fit.distortion_sd);
}

std::string json_of(const Autocalibration& found) {
  Json json{{"rough", true},
            {"source", words_of(found.source).key},
            {"width", found.fit.lens.size_px.width},
            {"height", found.fit.lens.size_px.height},
            {"frames", found.frames}};
  json["lens"] = fit_json(found.fit);
  json["gyroscope"] = gyro_json(found.gyro);
  json["turn"] = answer_json(found.turn);
  json["stated"] = answer_json(found.stated);
  json["warnings"] = Json::array();
  for (const Warning& warning : found.warnings) json["warnings"].push_back(warning.text());
  return json_text(json);
}

namespace {

constexpr PlotColor kMeasured{20, 90, 180}, kPinhole{120, 120, 120};

struct Row {
  std::string name;
  LensAnswer answer;
};

std::vector<Row> rows_of(const Autocalibration& found) {
  std::vector<Row> rows{{"gyroscope", found.gyro.answer}, {"turns", found.turn}, {"file states", found.stated}};
  if (found.source == AutocalibrationSource::given) rows.push_back({"--fov", {.fit = found.fit, .reason = {}}});
  return rows;
}

// A row for each source: its field of view with the limits, or why it has none.
Plot fields_plot(const Autocalibration& found) {
  const std::vector<Row> rows = rows_of(found);
  PlotSeries limits{.color = kMeasured};
  PlotSeries fields{.kind = SeriesKind::marks, .color = kMeasured};
  std::vector<PlotTick> names;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const auto row = static_cast<double>(i);
    names.push_back({row, rows[i].name});
    if (!rows[i].answer.fit) continue;
    const LensEstimate& fit = *rows[i].answer.fit;
    limits.runs.push_back({{deg_of_rad(fit.field_low_rad), row}, {deg_of_rad(fit.field_high_rad), row}});
    fields.runs.push_back({{deg_of_rad(fit.lens.horizontal_field_rad()), row}});
  }
  PlotSpan degrees = range_of({limits, fields}, &PlotPoint::x, 0.1);
  degrees = {std::floor(degrees.first / 5 - 0.5) * 5, std::ceil(degrees.last / 5 + 0.5) * 5};
  Plot plot{.title = "horizontal field of view, degrees, with 95 % limits",
            .x_range = degrees,
            .y_range = {static_cast<double>(rows.size()) - 0.5, -0.5},
            .y_ticks = std::move(names),
            .height = 340};
  constexpr std::size_t kLine = 110;  // letters of a reason that fit
  for (std::size_t i = 0; i < rows.size(); ++i)
    if (!rows[i].answer.fit)
      plot.notes.push_back(
          {{(degrees.first + degrees.last) / 2, static_cast<double>(i)}, rows[i].answer.reason.substr(0, kLine)});
  plot.series = {std::move(limits), std::move(fields)};
  return plot;
}

PlotSeries angles_of(std::string title, const DivisionLens& lens, PlotColor color) {
  PlotSeries series{.title = std::move(title), .runs = {{}}, .color = color};
  for (int i = 0; i <= 200; ++i) {
    const double r_px = lens.radius_px() * i / 200;
    const double angle_rad =
        std::atan2(r_px, lens.focal_px * (1 + lens.distortion * std::pow(r_px / lens.radius_px(), 2)));
    series.runs.front().push_back({r_px, deg_of_rad(angle_rad)});
  }
  return series;
}

Plot curve_plot(const DivisionLens& lens) {
  DivisionLens pinhole = lens;
  pinhole.distortion = 0;
  const std::vector<PlotSeries> series{angles_of("a pinhole of the same focal length", pinhole, kPinhole),
                                       angles_of("the lens", lens, kMeasured)};
  return {.title = "angle from the axis, degrees",
          .x_label = "distance from the centre, px",
          .x_range = {0, lens.radius_px()},
          .y_range = {0, range_of(series, &PlotPoint::y).last},
          .series = series,
          .height = 400};
}

}  // namespace

cv::Mat autocalibration_plot(const Autocalibration& found) {
  return image_of({fields_plot(found), curve_plot(found.fit.lens)});
}

}  // namespace sigs

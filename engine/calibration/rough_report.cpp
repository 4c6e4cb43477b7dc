// SPDX-License-Identifier: MIT
#include "calibration/rough_calibration.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <opencv2/imgproc.hpp>
#include <string>
#include <utility>
#include <vector>

#include "base/pose.h"

namespace sigs {

namespace {

using Json = nlohmann::ordered_json;

Json fit_json(const RoughFit& fit) {
  return {{"horizontal_field_deg", deg_of_rad(fit.lens.horizontal_field_rad())},
          {"horizontal_field_low_deg", deg_of_rad(fit.field_low_rad)},
          {"horizontal_field_high_deg", deg_of_rad(fit.field_high_rad)},
          {"focal_px", fit.lens.focal_px},
          {"distortion", fit.lens.distortion},
          {"distortion_sd", fit.distortion_sd}};
}

Json answer_json(const RoughAnswer& answer) {
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

Json lines_json(const LinesAnswer& lines) {
  Json json{{"used", lines.is_certain}, {"remark", lines.reason}, {"lines", lines.lines}, {"agree", lines.agree}};
  if (!lines.is_certain) return json;
  json["distortion"] = lines.distortion;
  json["distortion_sd"] = lines.sd;
  return json;
}

}  // namespace

Result<CalibrationText> calibration_text(const RoughCalibration& found) {
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

std::string summary_of(const RoughCalibration& found) {
  const RoughFit& fit = found.fit;
  const double field_deg = deg_of_rad(fit.lens.horizontal_field_rad());
  const std::string limits =
      fit.field_low_rad < fit.field_high_rad
          ? fmt::format(" (95 %: {:.1f} to {:.1f})", deg_of_rad(fit.field_low_rad), deg_of_rad(fit.field_high_rad))
          : std::string();
  return fmt::format(
      "field of view {:.1f} degrees across{}, focal length {:.1f} px, by {}; distortion {:.3f} +- {:.3f}{}", field_deg,
      limits, fit.lens.focal_px, name_of(found.source), fit.lens.distortion, fit.distortion_sd,
      found.distortion_by_lines ? ", straight edges agree" : "");
}

std::string json_of(const RoughCalibration& found) {
  Json json{{"rough", true},
            {"source", found.source == RoughSource::given       ? "given"
                       : found.source == RoughSource::gyroscope ? "gyroscope"
                       : found.source == RoughSource::turn      ? "turn"
                                                                : "stated"},
            {"width", found.fit.lens.size_px.width},
            {"height", found.fit.lens.size_px.height},
            {"frames", found.frames}};
  json["lens"] = fit_json(found.fit);
  json["gyroscope"] = gyro_json(found.gyro);
  json["turn"] = answer_json(found.turn);
  json["lines"] = lines_json(found.lines);
  json["stated"] = answer_json(found.stated);
  json["warnings"] = Json::array();
  for (const Warning& warning : found.warnings) json["warnings"].push_back(warning.text());
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

namespace {

const cv::Size kSize_px(1180, 700);
const cv::Rect kBars(190, 60, 940, 240);  // fields of view
const cv::Rect kCurve(190, 400, 940, 240);
const cv::Scalar kRoughInk(40, 40, 40);
const cv::Scalar kGrid(220, 220, 220);
const cv::Scalar kMeasured(180, 90, 20);
const cv::Scalar kPinhole(120, 120, 120);

void write_text(cv::Mat& image, const std::string& text, cv::Point at, const cv::Scalar& colour = kRoughInk) {
  cv::putText(image, text, at, cv::FONT_HERSHEY_SIMPLEX, 0.45, colour, 1, cv::LINE_AA);
}

// A text in lines of at most so many characters.
void write_lines(cv::Mat& image, const std::string& text, cv::Point at) {
  constexpr std::size_t kLine = 110;
  for (std::size_t from = 0; from < text.size() && from < 2 * kLine; from += kLine)
    write_text(image, text.substr(from, kLine), at + cv::Point(0, static_cast<int>(from / kLine) * 16), kPinhole);
}

struct Row {
  std::string name;
  RoughAnswer answer;
};

std::vector<Row> rows_of(const RoughCalibration& found) {
  std::vector<Row> rows{{"gyroscope", found.gyro.answer}, {"turns", found.turn}, {"file states", found.stated}};
  if (found.source == RoughSource::given) rows.push_back({"--fov", {.fit = found.fit, .reason = {}}});
  return rows;
}

void draw_fields(cv::Mat& image, const RoughCalibration& found) {
  double low = found.fit.field_low_rad;
  double high = found.fit.field_high_rad;
  const std::vector<Row> rows = rows_of(found);
  for (const Row& row : rows)
    if (row.answer.fit) {
      low = std::min(low, row.answer.fit->field_low_rad);
      high = std::max(high, row.answer.fit->field_high_rad);
    }
  const int first_deg = static_cast<int>(std::floor(deg_of_rad(low) / 5 - 0.5)) * 5;
  const int last_deg = static_cast<int>(std::ceil(deg_of_rad(high) / 5 + 0.5)) * 5;
  const auto x_of = [&](double rad) {
    return kBars.x + static_cast<int>(kBars.width * (deg_of_rad(rad) - first_deg) / (last_deg - first_deg));
  };
  write_text(image, "horizontal field of view, degrees, with 95 % limits", {kBars.x, kBars.y - 20});
  for (int deg = first_deg; deg <= last_deg; deg += 5) {
    const int x = x_of(rad_of_deg(deg));
    cv::line(image, {x, kBars.y}, {x, kBars.br().y}, kGrid);
    write_text(image, std::to_string(deg), {x - 8, kBars.br().y + 18});
  }
  const int step = kBars.height / static_cast<int>(rows.size() + 1);
  for (int i = 0; i < static_cast<int>(rows.size()); ++i) {
    const Row& row = rows[static_cast<std::size_t>(i)];
    const int y = kBars.y + step * (i + 1);
    write_text(image, row.name, {20, y + 5});
    if (!row.answer.fit) {
      write_lines(image, row.answer.reason, {kBars.x + 6, y + 5});
      continue;
    }
    const RoughFit& fit = *row.answer.fit;
    cv::line(image, {x_of(fit.field_low_rad), y}, {x_of(fit.field_high_rad), y}, kMeasured, 3, cv::LINE_AA);
    cv::circle(image, {x_of(fit.lens.horizontal_field_rad()), y}, 6, kMeasured, cv::FILLED, cv::LINE_AA);
  }
}

void draw_curve(cv::Mat& image, const RoughLens& lens) {
  write_text(image, "angle from the axis by distance from the centre (grey: a pinhole of the same focal length)",
             {kCurve.x, kCurve.y - 20});
  const auto angle_at = [](const RoughLens& by, double r_px) {
    return std::atan2(r_px, by.focal_px * (1 + by.distortion * std::pow(r_px / by.radius_px(), 2)));
  };
  RoughLens pinhole = lens;
  pinhole.distortion = 0;
  const double top = std::max(angle_at(lens, lens.radius_px()), angle_at(pinhole, lens.radius_px()));
  const RoughLens& found = lens;
  for (const RoughLens* const drawn : {&std::as_const(pinhole), &found}) {
    const cv::Scalar& colour = drawn == &found ? kMeasured : kPinhole;
    std::vector<cv::Point> points;
    for (int x = 0; x <= kCurve.width; x += 4) {
      const double angle = angle_at(*drawn, lens.radius_px() * x / kCurve.width);
      points.emplace_back(kCurve.x + x, kCurve.br().y - static_cast<int>(kCurve.height * angle / top));
    }
    cv::polylines(image, points, false, colour, 2, cv::LINE_AA);
  }
  cv::rectangle(image, kCurve, kGrid);
  write_text(image, fmt::format("{:.0f} deg", deg_of_rad(top)), {110, kCurve.y + 8});
  write_text(image, "0", {170, kCurve.br().y});
  write_text(image, fmt::format("{:.0f} px", lens.radius_px()), {kCurve.br().x - 40, kCurve.br().y + 18});
}

}  // namespace

cv::Mat rough_plot(const RoughCalibration& found) {
  cv::Mat image(kSize_px, CV_8UC3, cv::Scalar(255, 255, 255));
  draw_fields(image, found);
  draw_curve(image, found.fit.lens);
  const std::string lines =
      found.lines.is_certain ? fmt::format("straight edges: distortion {:.3f} +- {:.3f}, {} of {} edges agree",
                                           found.lines.distortion, found.lines.sd, found.lines.agree, found.lines.lines)
                             : "straight edges: " + found.lines.reason;
  write_text(image, lines, {20, kSize_px.height - 20});
  return image;
}

}  // namespace sigs

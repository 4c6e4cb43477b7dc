// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "base/pose.h"
#include "calibration/rough_calibration.h"

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

}  // namespace sigs

// SPDX-License-Identifier: MIT
#include "labels/formats.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <string>
#include <string_view>
#include <utility>

#include "base/ensure.h"
#include "base/text.h"
#include "labels/label_files.h"
#include "labels/label_text.h"

namespace sigs {

namespace {

constexpr std::string_view kCsvHeader =
    "frame,time_s,camera_x_m,camera_y_m,camera_z_m,camera_roll_deg,camera_pitch_deg,camera_yaw_deg,"
    "id,name,category,in_picture,inside_fraction,visible_fraction,horizon,"
    "x_m,y_m,z_m,distance_m,roll_deg,pitch_deg,yaw_deg,"
    "box_x_px,box_y_px,box_width_px,box_height_px,visible_pixels,"
    "silhouette_x_px,silhouette_y_px,silhouette_width_px,silhouette_height_px,"
    "sequence,video,picture_width_px,picture_height_px,frame_rate,substituted,"
    "camera_position_source,camera_attitude_source,camera_sd_x_deg,camera_sd_y_deg,camera_sd_z_deg,"
    "camera_latitude_deg,camera_longitude_deg,camera_height_m,latitude_deg,longitude_deg,height_m";

// Of the numbers of appearance, in this order, before the columns of encounters.
constexpr std::array kAppearanceColumns{"weber_contrast", "rms_contrast",   "signal_to_noise",
                                        "blur_px",        "motion_blur_px", "visibility_m"};

// With the columns of encounters where there are some; "dwc-en-route" becomes "dwc_en_route_lost" and so on, as names
// of columns have no hyphens.
std::string csv_header(const LabelSequence& sequence) {
  std::string header(kCsvHeader);
  for (const char* const column : kAppearanceColumns) header += std::string(",") + column;
  if (!sequence.volumes.empty())
    header +=
        ",range_rate_mps,closing_speed_mps,bearing_deg,elevation_deg,hmd_m,vmd_m,"
        "time_to_closest_approach_s,time_to_coaltitude_s";
  for (std::string name : sequence.volumes) {
    std::replace(name.begin(), name.end(), '-', '_');
    for (const char* const column : {"_lost", "_tau_mod_s", "_severity"}) header += "," + csv_field(name + column);
  }
  return header + "\r\n";
}

// One line, field by field.
class CsvRow {
 public:
  void add(std::string_view text) {
    if (!text_.empty()) text_ += ',';
    text_ += csv_field(text);
  }
  void add(double number, int decimals = kLabelDecimals) { add(number_text(number, decimals)); }
  // Infinite: empty.
  void add_if_finite(double number) { std::isfinite(number) ? add(number) : add_empty(1); }
  void add(int number) { add(std::to_string(number)); }
  // Those that are missing of `fields` or infinite: empty.
  void add(const LabelNumbers& numbers, int fields) {
    for (const LabelNumber& number : numbers)
      std::isfinite(number.value) ? add(number.value, number.decimals) : add_empty(1);
    add_empty(fields - static_cast<int>(numbers.size()));
  }
  // Those of the columns, by their names. One that there is not is empty.
  void add(const LabelNumbers& numbers, std::span<const char* const> columns) {
    for (const std::string_view column : columns) {
      const auto number = std::ranges::find(numbers, column, &LabelNumber::name);
      number == numbers.end() ? add_empty(1) : add(number->value, number->decimals);
    }
  }
  // Fields that are separated by commas and quoted where they need to be.
  void add_fields(const std::string& fields) { text_ += "," + fields; }
  void add_empty(int fields) { text_ += std::string(static_cast<std::size_t>(fields), ','); }
  [[nodiscard]] std::string line() const { return text_ + "\r\n"; }

 private:
  std::string text_;
};

void add_encounter_fields(CsvRow& row, const IntruderTruth& truth, std::size_t volumes) {
  if (volumes == 0) return;
  if (!truth.encounter) return row.add_empty(8 + 3 * static_cast<int>(volumes));
  row.add(encounter_numbers(*truth.encounter), 8);
  ENSURE(truth.encounter->of_volumes.size() == volumes);
  for (const WellClearTruth& volume : truth.encounter->of_volumes) {
    row.add(volume.is_lost ? "true" : "false");
    row.add_if_finite(volume.tau_mod_s);
    row.add(volume.severity);
  }
}

class CsvLabels : public OneFileLabels {
 public:
  using OneFileLabels::OneFileLabels;

  Result<void> begin() override { return file_.put(csv_header(sequence_)); }

  Result<void> write(const FrameTruth& truth) override {
    std::string text;
    for (const IntruderTruth& intruder : truth.intruders) text += row_of(truth, intruder);
    return file_.put(text);
  }

 private:
  [[nodiscard]] std::string row_of(const FrameTruth& frame, const IntruderTruth& truth) const {
    CsvRow row;
    row.add(frame.index);
    row.add(frame.time_s);
    row.add(position_numbers(frame.camera_position_m), 3);
    row.add(attitude_numbers(frame.world_from_camera), 3);
    row.add(truth.id);
    row.add(xml_text(truth.name));
    row.add(xml_text(labelled_intruder(sequence_, truth.id).category));
    row.add(truth.in_image ? "true" : "false");
    row.add(truth.inside_fraction);
    row.add(truth.visible_fraction);
    row.add(name_of(truth.horizon));
    row.add(position_numbers(truth.position_m), 3);
    row.add(glm::length(truth.position_m));
    row.add(attitude_numbers(truth.world_from_body), 3);
    row.add(box_numbers(truth), 5);
    row.add(silhouette_numbers(truth), 4);
    add_footage(row);
    row.add(frame.substituted ? "true" : "false");
    row.add_fields(camera_source_fields(frame.camera));
    row.add_fields(place_fields(truth.place));
    row.add(appearance_numbers(truth), kAppearanceColumns);
    add_encounter_fields(row, truth, sequence_.volumes.size());
    return row.line();
  }

  void add_footage(CsvRow& row) const {
    const FootageTruth& footage = sequence_.footage;
    row.add(xml_text(sequence_.name));
    row.add(xml_text(footage.video));
    row.add(footage.size_px.width);
    row.add(footage.size_px.height);
    row.add(rate_text(footage));
  }
};

}  // namespace

Result<std::unique_ptr<LabelWriter>> open_csv(const std::filesystem::path& path, const LabelSequence& sequence) {
  return begun_file<CsvLabels>(path, sequence);
}

}  // namespace sigs

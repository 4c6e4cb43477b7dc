// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "geo/geodetic.h"

namespace sigs {

// One subtitle of a drone by DJI, as text and as what the text says. The dialects differ between models and versions;
// none is documented by DJI.
struct DjiCue {
  std::string_view text;            // without number, time line and markup
  std::size_t line = 0;             // of the file, from 1; 0: not from a file
  std::optional<double> footage_s;  // when the subtitle is shown: its time line, or what the container says
};

// The cues of a file in SubRip's form: a number, a line "00:00:01,000 --> 00:00:02,000", which one dialect lacks, and
// lines of text. Views into the text, which must outlive them.
[[nodiscard]] std::vector<DjiCue> dji_cues(std::string_view text);

// Where a cue has its latitude and longitude.
enum class DjiPlaceForm {
  none,
  named,            // [latitude: 41.4] [longitude: 2.2], also "longtitude"
  longitude_first,  // GPS(2.2, 41.4, 17): the third is the number of satellites
  latitude_first,   // GPS(41.4, 2.2, 0.0M): a third with a unit; Matrice 300
};

// What one cue says. Angles in degrees; yaw from north.
struct DjiValues {
  DjiPlaceForm place_form = DjiPlaceForm::none;
  bool has_place = false;                                          // latitude and longitude are numbers, and not "n/a"
  GeodeticPosition place;                                          // without its height
  int place_decimals = 0;                                          // digits behind the point of the latitude
  std::optional<double> absolute_height_m;                         // abs_alt
  std::optional<double> altitude_m;                                // altitude: from what is not said
  std::optional<double> relative_height_m;                         // rel_alt, BAROMETER, Hb, H: above the start
  std::optional<double> exposure_s;                                // shutter, Shutter, TV, SS
  std::optional<double> white_cdpm2;                               // by exposure_s, iso or ISO, fnum, Fnum, IR or F/
  std::optional<std::array<double, 3>> gimbal_roll_pitch_yaw_deg;  // gb_roll.., G.PRY
  std::optional<std::array<double, 3>> airframe_roll_pitch_yaw_deg;  // F.PRY
  std::optional<double> focal_length_35mm_mm;  // focal_len, with the digital zoom: for a sensor 36 mm wide
  std::optional<double> local_time_s;          // the date, counted as if it were UTC
};

[[nodiscard]] DjiValues dji_values(std::string_view text);

}  // namespace sigs

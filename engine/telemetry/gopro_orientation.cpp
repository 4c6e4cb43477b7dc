// SPDX-License-Identifier: MIT
#include "telemetry/gopro_stream.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string_view>
#include <vector>

#include "base/interpolation.h"
#include "base/pose.h"
#include "base/statistics.h"
#include "base/text.h"
#include "telemetry/log_samples.h"

namespace sigs {
namespace {

// Of "ZXY": the matrix that takes the columns to X, Y, Z. Nothing where the letters are not each of the three once.
std::optional<glm::dmat3> axes_from_letters(std::string_view letters) {
  if (letters.size() != 3) return {};
  glm::dmat3 axes(0.0);  // axes[column][row]
  bool seen[3] = {false, false, false};
  for (int column = 0; column < 3; ++column) {
    const char letter = letters[static_cast<std::size_t>(column)];
    const bool reversed = letter >= 'a';
    const int axis = letter - (reversed ? 'x' : 'X');
    if (axis < 0 || axis > 2 || seen[axis]) return {};
    seen[axis] = true;
    axes[column][axis] = reversed ? -1 : 1;
  }
  return axes;
}

std::optional<glm::dmat3> axes_from_matrix(const GoproStream& stream) {
  const std::optional<glm::dmat3> of_output = axes_from_letters(stream.axes_out);
  if (!of_output || stream.matrix.size() != 9) return {};
  glm::dmat3 matrix;
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 3; ++column)
      matrix[column][row] = stream.matrix[static_cast<std::size_t>(3 * row + column)];
  // A rotation, mirrored or not; anything else would change lengths.
  const glm::dmat3 square = glm::transpose(matrix) * matrix;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      if (!(std::abs(square[i][j] - (i == j ? 1 : 0)) < 0.01)) return {};
  return *of_output * matrix;
}

// One word in the brackets of a stream's name; empty: not known.
std::string letter_of(std::string_view word) {
  const bool reversed = word.starts_with('-');
  if (reversed) word.remove_prefix(1);
  const std::string text = lower_case(word);
  const std::string_view letter = text == "x" || text == "right/left"     ? "X"
                                  : text == "y" || text == "forward/back" ? "Y"
                                  : text == "z" || text == "up/down"      ? "Z"
                                                                          : "";
  return reversed ? lower_case(letter) : std::string(letter);
}

// "Gyroscope (z,x,y)" -> "ZXY"
std::string letters_of_name(std::string_view name) {
  const std::size_t open = name.find('(');
  const std::size_t close = name.find(')');
  if (open == std::string_view::npos || close == std::string_view::npos || close < open) return {};
  std::string letters;
  std::string_view list = name.substr(open + 1, close - open - 1);
  while (!list.empty()) {
    const std::size_t comma = std::min(list.find(','), list.size());
    letters += letter_of(trimmed(list.substr(0, comma)));
    list.remove_prefix(std::min(comma + 1, list.size()));
  }
  return letters;
}

std::string letters_of_model(const std::string& device) {
  const std::string name = lower_case(device);
  if (name.find("hero6") != std::string::npos || name.find("hero7") != std::string::npos) return "YxZ";
  if (name.find("fusion") != std::string::npos) return "yXZ";
  if (name.find("hero5") != std::string::npos) return "ZXY";
  return {};
}

constexpr double kApart_rad = rad_of_deg(5);

glm::dquat turn_at(const Channel<glm::dquat>& channel, double time_s) {
  return value_at(channel.times_s, channel.values, time_s);
}

// The smallest turn that takes a direction to Z.
glm::dquat turn_to_down(const glm::dvec3& direction) {
  const glm::dvec3 down(0, 0, 1);
  const double along = glm::dot(direction, down);
  if (along < -1 + 1e-12) return {0, 1, 0, 0};
  return glm::normalize(glm::dquat(1 + along, glm::cross(direction, down)));
}

std::optional<glm::dvec3> down_at_start(Track& track) {
  const Channel<glm::dvec3>& gravity = track.camera_gravity;
  if (gravity.empty()) return std::nullopt;
  glm::dvec3 sum(0);
  std::vector<glm::dvec3> all;
  for (std::size_t i = 0; i < gravity.values.size(); ++i) {
    all.push_back(turn_at(track.start_from_camera, gravity.times_s[i]) * gravity.values[i]);
    sum += all.back();
  }
  std::vector<double> apart_rad;
  for (const glm::dvec3& down : all) apart_rad.push_back(angle_between(down, sum));
  const double median_rad = median(apart_rad);
  if (median_rad <= kApart_rad) return glm::normalize(sum);
  track.warnings.push_back(
      {track.file.string() + ": GRAV",
       fmt::format("does not turn with CORI: by {:.1f} degrees in the median; where level is, is not known",
                   deg_of_rad(median_rad))});
  return std::nullopt;
}

}  // namespace

GoproAxes gopro_axes(const GoproStream& stream) {
  // Columns of this matrix: where GoPro's X (left), Y (backwards) and Z (up) lie in camera axes.
  const glm::dmat3 camera_from_gopro(glm::dvec3(0, -1, 0), glm::dvec3(-1, 0, 0), glm::dvec3(0, 0, -1));
  if (const auto axes = axes_from_letters(stream.axes_in))
    return {camera_from_gopro * *axes, "ORIN " + stream.axes_in, false};
  if (const auto axes = axes_from_matrix(stream)) return {camera_from_gopro * *axes, "MTRX and ORIO", false};
  if (const auto axes = axes_from_letters(letters_of_name(stream.name)))
    return {camera_from_gopro * *axes, "the stream's name", false};
  if (const auto axes = axes_from_letters(letters_of_model(stream.device)))
    return {camera_from_gopro * *axes, "the camera's name", false};
  return {camera_from_gopro * axes_from_letters("ZXY").value(), "HERO5", true};
}

void join_camera_attitude(Track& track) {
  if (track.start_from_camera.empty() || !track.ned_from_airframe.empty()) return;
  const Channel<glm::dquat>& image = track.camera_from_image;
  Channel<glm::dquat>& joined = track.ned_from_camera;
  joined = track.start_from_camera;
  if (!image.empty()) joined.source += " * IORI";
  for (std::size_t i = 0; i < joined.values.size() && !image.empty(); ++i)
    joined.values[i] = glm::normalize(joined.values[i] * turn_at(image, joined.times_s[i]));
  const std::optional<glm::dvec3> down = down_at_start(track);
  const glm::dquat first = joined.values.front();
  const glm::dquat level = down ? turn_to_down(*down) : glm::conjugate(first);
  const glm::dquat heading = rotation_of({0, 0, down ? -attitude_of(level * first).yaw_rad : 0});
  for (glm::dquat& value : joined.values) value = glm::normalize(heading * level * value);
  track.heading_is_north = false;
  track.level_is_known = down.has_value();
  track.attitude_is_whole = true;
}

}  // namespace sigs

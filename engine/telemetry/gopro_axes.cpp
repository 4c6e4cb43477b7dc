// SPDX-License-Identifier: MIT
#include "telemetry/gopro_axes.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string_view>

#include "base/text.h"

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

}  // namespace sigs

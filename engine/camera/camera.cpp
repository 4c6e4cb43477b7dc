// SPDX-License-Identifier: MIT
#include "camera/camera.h"

#include <string>
#include <string_view>
#include <utility>

#include "base/staged_outputs.h"
#include "camera/calibration_fields.h"
#include "camera/gyroflow.h"
#include "camera/opencv_storage.h"
#include "camera/plain_yaml.h"

namespace sigs {
namespace {

using calibration::Fields;

// Without a byte order mark and leading blanks, which the parsers stumble over.
std::string trimmed(std::string text) {
  constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
  if (text.starts_with(kByteOrderMark)) text.erase(0, kByteOrderMark.size());
  text.erase(0, text.find_first_not_of(" \t\r\n"));
  return text;
}

Result<Fields> fields_in(const std::string& text, const std::string& file_name) {
  if (text.empty()) return fail(file_name, "is empty");
  if (text.find('\0') != std::string::npos) return fail(file_name, "is not a text file");
  // "%YAML:1.0" is OpenCV's own header; the YAML standard has a space in the colon's place.
  if (text.starts_with('<') || text.starts_with("%YAML:")) return calibration::opencv_storage_fields(text, file_name);
  if (text.starts_with('{')) return calibration::json_fields(text, file_name);
  return calibration::plain_yaml_fields(text, file_name);
}

}  // namespace

Result<Camera> read_calibration(const std::filesystem::path& path, std::optional<cv::Size> footage_size_px,
                                std::optional<LensModel> model) {
  const std::string file_name = path.filename().string();
  Result<std::string> text = read_text(path, kCalibrationLimit_bytes);
  if (!text) return fail(text.error());
  const Result<Fields> fields = fields_in(trimmed(*std::move(text)), file_name);
  if (!fields) return fail(fields.error());
  return calibration::camera_from(*fields, file_name, footage_size_px, model);
}

}  // namespace sigs

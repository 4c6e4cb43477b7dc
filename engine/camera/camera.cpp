// SPDX-License-Identifier: MIT
#include "camera/camera.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <span>
#include <string>
#include <string_view>
#include <utility>

#include "base/staged_outputs.h"
#include "base/text.h"
#include "camera/calibration_formats.h"

namespace sigs::calibration {
namespace {

using Names = std::span<const std::string_view>;

constexpr std::array<std::string_view, 6> kMatrixNames{
    "camera_matrix", "Camera_Matrix", "cameraMatrix", "K", "k", "M1"};
constexpr std::array<std::string_view, 12> kCoefficientNames{"distortion_coefficients",
                                                             "Distortion_Coefficients",
                                                             "distortionCoefficients",
                                                             "distortion_coeffs",
                                                             "dist_coeffs",
                                                             "dist_coefs",
                                                             "dist_coeff",
                                                             "distCoeffs",
                                                             "D",
                                                             "d",
                                                             "D1",
                                                             "distortion"};
constexpr std::array<std::string_view, 4> kSizeNames{"image_size", "image_Size", "imageSize", "Image_Size"};
constexpr std::array<std::string_view, 4> kWidthNames{"image_width", "image_Width", "imageWidth", "width"};
constexpr std::array<std::string_view, 4> kHeightNames{"image_height", "image_Height", "imageHeight", "height"};
constexpr std::array<std::string_view, 3> kFisheyeNames{"fisheye_model", "fisheye", "fisheyeModel"};
constexpr std::array<std::string_view, 1> kModelNames{"distortion_model"};
constexpr std::array<std::string_view, 2> kMirrorNames{"xi", "Xi"};  // of OpenCV's omnidirectional calibrations

std::string joined(Names names) {
  return fmt::format("{}", fmt::join(names, ", "));
}

// Reads the fields by the keys that docs/calibration-files.md lists. Its messages name the file and, where one is at
// fault, the field.
struct Reader {
  const Fields& fields;
  const std::string& file;

  [[nodiscard]] std::string where(const Field& field) const { return file + ": " + field.name; }
  [[nodiscard]] Result<std::optional<LensModel>> named_model() const;
  [[nodiscard]] Result<std::optional<LensModel>> stated_model() const;
  [[nodiscard]] Result<void> read_matrix(LensParameters& lens, bool may_be_skew) const;
  [[nodiscard]] Result<void> read_coefficients(LensParameters& lens, std::optional<LensModel> model) const;
  [[nodiscard]] Result<void> choose_model(LensParameters& lens, std::optional<LensModel> wanted,
                                          const Result<std::optional<LensModel>>& stated,
                                          std::vector<Warning>& warnings) const;
  [[nodiscard]] Result<int> whole_pixels(const Field& field, double number) const;
  [[nodiscard]] Result<std::optional<cv::Size>> size() const;
};

// The model that the file states by OpenCV's flag, or by a name as ROS and Kalibr write it. Where they disagree the
// flag is taken, except that a flag of 0 yields to a name. Nothing where the file states neither.
Result<std::optional<LensModel>> Reader::named_model() const {
  const Field* flag = found(fields, kFisheyeNames);
  if (flag != nullptr) {
    if (flag->text == "true" || flag->text == "True") return LensModel::kannala_brandt;
    if (flag->text == "false" || flag->text == "False") return LensModel::brown_conrady;
    if (flag->numbers.size() != 1 || flag->not_a_number) return fail(where(*flag), "expected 0 or 1");
    if (flag->numbers.front() != 0) return LensModel::kannala_brandt;
  }
  const Field* model = found(fields, kModelNames);
  if (model == nullptr || model->text.empty())
    return flag == nullptr ? std::nullopt : std::optional(LensModel::brown_conrady);
  if (const std::optional<LensModel> named = lens_model_named(model->text)) return named;
  std::vector<std::string_view> known;
  for (const LensModelTraits& traits : lens_models()) known.push_back(traits.names_in_files.front());
  return fail(where(*model),
              fmt::format("distortion model '{}' is not supported; known are {}", model->text, fmt::join(known, ", ")));
}

// By a mirror's parameter, which goes before all else.
Result<std::optional<LensModel>> Reader::stated_model() const {
  if (found(fields, kMirrorNames) != nullptr) return LensModel::omnidirectional;
  return named_model();
}

// skew: of the omnidirectional model a coefficient, of no other one.
Result<void> Reader::read_matrix(LensParameters& lens, bool may_be_skew) const {
  const Field* field = found(fields, kMatrixNames);
  if (field == nullptr) return fail(file, "no camera matrix; looked for " + joined(kMatrixNames));
  if (const auto good = check_numbers(*field, file); !good) return fail(good.error());
  const std::vector<double>& m = field->numbers;
  if (m.size() != 9) return fail(where(*field), fmt::format("expected 9 numbers, found {}", m.size()));
  lens.fx = m[0], lens.fy = m[4], lens.cx = m[2], lens.cy = m[5];
  if (!(lens.fx > 0 && lens.fy > 0))
    return fail(where(*field),
                fmt::format("focal lengths must be positive, are {} and {}", text_of(lens.fx), text_of(lens.fy)));
  constexpr double kRounding = 1e-6;  // of the focal length: a solver's residual where the value was fixed at zero
  const bool is_skew = std::abs(m[1]) > kRounding * lens.fx && !may_be_skew;
  if (is_skew || std::abs(m[3]) > kRounding * lens.fx)
    return fail(where(*field), fmt::format("skew is not supported; the 2nd and 4th numbers must be 0, are {} and {}",
                                           text_of(m[1]), text_of(m[3])));
  constexpr double kLastRowRounding = 1e-9;
  if (std::abs(m[6]) > kLastRowRounding || std::abs(m[7]) > kLastRowRounding || std::abs(m[8] - 1) > kLastRowRounding)
    return fail(where(*field),
                fmt::format("the last row must be 0 0 1, is {} {} {}", text_of(m[6]), text_of(m[7]), text_of(m[8])));
  return {};
}

// A model without coefficients needs no list of them.
Result<void> Reader::read_coefficients(LensParameters& lens, std::optional<LensModel> model) const {
  const Field* field = found(fields, kCoefficientNames);
  if (field == nullptr && model && std::ranges::max(traits_of(*model).coefficient_counts) == 0) return {};
  if (field == nullptr) return fail(file, "no distortion coefficients; looked for " + joined(kCoefficientNames));
  if (const auto good = check_numbers(*field, file); !good) return fail(good.error());
  lens.coefficients = field->numbers;
  const Field* mirror = model == LensModel::omnidirectional ? found(fields, kMirrorNames) : nullptr;
  if (mirror == nullptr) return {};
  if (const auto good = check_numbers(*mirror, file); !good) return fail(good.error());
  if (mirror->numbers.size() != 1) return fail(where(*mirror), "expected one number");
  if (lens.coefficients.size() != 4 && !lens.coefficients.empty())
    return fail(where(*field), fmt::format("expected 4 coefficients k1 k2 p1 p2 beside {}, found {}", mirror->name,
                                           lens.coefficients.size()));
  lens.coefficients.resize(4);
  lens.coefficients.insert(lens.coefficients.begin(), mirror->numbers.front());
  const double skew = found(fields, kMatrixNames)->numbers[1];
  if (skew != 0) lens.coefficients.push_back(skew / lens.fx);
  return {};
}

// The model that is wanted, else the one that the file states, else the one that its coefficients suggest.
Result<void> Reader::choose_model(LensParameters& lens, std::optional<LensModel> wanted,
                                  const Result<std::optional<LensModel>>& stated,
                                  std::vector<Warning>& warnings) const {
  if (!stated) return fail(stated.error());
  // The distortion of a pinhole is part of the omnidirectional model.
  const auto other = named_model().value_or(std::nullopt).value_or(LensModel::brown_conrady);
  if (!wanted && *stated == LensModel::omnidirectional && other != LensModel::omnidirectional &&
      other != LensModel::brown_conrady)
    warnings.push_back(
        {where(*found(fields, kMirrorNames)),
         fmt::format("makes the model omnidirectional, though the file names {} too", traits_of(other).word)});
  if (wanted || *stated) {
    lens.model = wanted ? *wanted : **stated;
    if (wanted && *stated && *wanted != **stated)
      warnings.push_back({file, fmt::format("says that it is of the {} model; it is read as {}, as asked for",
                                            traits_of(**stated).word, traits_of(*wanted).word)});
    return {};
  }
  const AssumedModel assumed = assumed_model(lens.coefficients);
  lens.model = assumed.model;
  if (!assumed.why.empty())
    warnings.push_back(
        {where(*found(fields, kCoefficientNames)),
         fmt::format("four coefficients can be Brown-Conrady (k1 k2 p1 p2) or fisheye (k1 k2 k3 k4), and the file does "
                     "not say which; read as {}, since {}: set footage.lens_model to brown_conrady or fisheye, or "
                     "fisheye_model to 0 or 1 in the file",
                     traits_of(assumed.model).word, assumed.why)});
  return {};
}

Result<int> Reader::whole_pixels(const Field& field, double number) const {
  constexpr double kMax = 1 << 20;
  if (!(number >= 1 && number <= kMax) || number != std::floor(number))
    return fail(where(field), "expected a whole number of pixels, found " + text_of(number));
  return static_cast<int>(number);
}

// Nothing where the file states no size at all.
Result<std::optional<cv::Size>> Reader::size() const {
  const Field* both = found(fields, kSizeNames);
  const Field* width = found(fields, kWidthNames);
  const Field* height = found(fields, kHeightNames);
  if (both == nullptr && width == nullptr && height == nullptr) return std::nullopt;
  if (width == nullptr && height == nullptr) {
    if (both->numbers.size() != 2 || both->not_a_number)
      return fail(where(*both), "expected 2 numbers, width and height");
    width = height = both;
  }
  if (width == nullptr) return fail(where(*height), "a height without a width; looked for " + joined(kWidthNames));
  if (height == nullptr) return fail(where(*width), "a width without a height; looked for " + joined(kHeightNames));
  for (const Field* field : {width, height})
    if (field != both && (field->numbers.size() != 1 || field->not_a_number))
      return fail(where(*field), "expected one number");
  const Result<int> width_px = whole_pixels(*width, width->numbers.front());
  if (!width_px) return fail(width_px.error());
  const Result<int> height_px = whole_pixels(*height, height->numbers.back());
  if (!height_px) return fail(height_px.error());
  return cv::Size(*width_px, *height_px);
}

cv::Size divided(cv::Size size_px, const cv::Point2d& by) {
  return {cvRound(size_px.width / by.x), cvRound(size_px.height / by.y)};
}

std::string size_names() {
  return fmt::format("{}; {} with {}", fmt::join(kSizeNames, ", "), fmt::join(kWidthNames, ", "),
                     fmt::join(kHeightNames, ", "));
}

// Without a byte order mark and leading white space, which the parsers do not take.
std::string without_beginning(std::string text) {
  constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
  if (text.starts_with(kByteOrderMark)) text.erase(0, kByteOrderMark.size());
  text.erase(0, text.find_first_not_of(" \t\r\n"));
  return text;
}

// The camera with this name; of an empty one the first.
Result<std::size_t> chosen(const std::vector<Fields::Group>& cameras, const CalibrationName& name) {
  if (name.camera.empty()) return 0;
  std::vector<std::string> names;
  for (std::size_t i = 0; i < cameras.size(); ++i) {
    if (cameras[i].name == name.camera) return i;
    if (!cameras[i].name.empty()) names.push_back(cameras[i].name);
  }
  return fail(name.file.filename().string(),
              fmt::format("has no camera '{}'; {}", name.camera,
                          names.empty() ? "it describes one alone: leave out what follows the #"
                                        : fmt::format("it has {}", fmt::join(names, ", "))));
}

// Of 360 degree footage the size says everything.
Result<Camera> equirectangular_camera_from(const Reader& reader, std::optional<cv::Size> footage_size_px) {
  const Result<std::optional<cv::Size>> own_size_px = reader.size();
  if (!own_size_px) return fail(own_size_px.error());
  if (!*own_size_px && !footage_size_px)
    return fail(reader.file, "no image size, and no footage to take it from; looked for " + size_names());
  const cv::Size from_px = own_size_px->value_or(footage_size_px.value_or(cv::Size()));
  const cv::Size to_px = footage_size_px.value_or(from_px);
  std::vector<Warning> warnings = reader.fields.warnings;
  const Result<LensParameters> scaled = scaled_calibration(equirectangular_camera(from_px).lens.parameters(), from_px,
                                                           to_px, {1, 1}, reader.file, warnings);
  if (!scaled) return fail(scaled.error());
  Camera camera = equirectangular_camera(to_px);
  const Field* matrix = found(reader.fields, kMatrixNames);
  const auto is_zero = [](double number) { return number == 0; };
  if (matrix != nullptr && !std::ranges::all_of(matrix->numbers, is_zero))
    warnings.push_back({reader.where(*matrix), "is not used: an equirectangular image covers 360 by 180 degrees"});
  camera.warnings.insert(camera.warnings.begin(), warnings.begin(), warnings.end());
  return camera;
}

}  // namespace

const Field* found(const Fields& fields, Names names) {
  for (const std::string_view name : names)
    if (const auto it = fields.find(name); it != fields.end()) return &it->second;
  return nullptr;
}

Result<void> check_numbers(const Field& field, const std::string& file_name) {
  const std::string where = file_name + ": " + field.name;
  if (field.not_a_number) return fail(where, fmt::format("'{}' is not a number", *field.not_a_number));
  if (field.stated_count && *field.stated_count != field.numbers.size())
    return fail(where,
                fmt::format("rows and cols say {} numbers, found {}", *field.stated_count, field.numbers.size()));
  for (const double number : field.numbers)
    if (!std::isfinite(number)) return fail(where, text_of(number) + " is not a finite number");
  return {};
}

Result<Fields> fields_of_file(const std::filesystem::path& path) {
  Result<std::string> text = read_text(path, kCalibrationLimit_bytes);
  if (!text) return fail(text.error());
  return fields_in(without_beginning(*std::move(text)), path.filename().string());
}

Result<Camera> camera_of(const Fields& fields, const std::string& file_name, std::optional<cv::Size> footage_size_px,
                         std::optional<LensModel> wanted_model, const std::optional<ImagePart>& part) {
  const Reader reader{fields, file_name};
  const Result<std::optional<LensModel>> stated = reader.stated_model();
  const std::optional<LensModel> model = wanted_model || !stated ? wanted_model : *stated;
  if (!needs_calibration(model)) return equirectangular_camera_from(reader, footage_size_px);
  LensParameters lens;
  if (const auto good = reader.read_matrix(lens, model == LensModel::omnidirectional); !good) return fail(good.error());
  if (const auto good = reader.read_coefficients(lens, model); !good) return fail(good.error());
  std::vector<Warning> warnings = fields.warnings;
  if (const auto good = reader.choose_model(lens, wanted_model, stated, warnings); !good) return fail(good.error());
  const Result<std::optional<cv::Size>> own_size_px = reader.size();
  if (!own_size_px) return fail(own_size_px.error());
  if (!*own_size_px && !footage_size_px)
    return fail(file_name, "no image size, and no footage to take it from; looked for " + size_names());
  const std::string matrix = reader.where(*found(fields, kMatrixNames));
  if (!*own_size_px && !footage_size_px->empty())
    if (const std::string why_not = why_not_made_for(lens, *footage_size_px); !why_not.empty())
      return fail(matrix, why_not);
  const cv::Point2d stretch = fields.stretch;
  const cv::Size from_px =
      own_size_px->value_or(divided(footage_size_px.value_or(cv::Size{}), {1 / stretch.x, 1 / stretch.y}));
  const cv::Size to_px = footage_size_px.value_or(divided(from_px, stretch));
  if (fields.kept_share != 1) crop(lens, from_px, fields.kept_share);
  const Result<bool> is_of_whole =
      part ? is_made_for_whole(divided(from_px, stretch), to_px, *part, file_name) : Result<bool>(false);
  if (!is_of_whole) return fail(is_of_whole.error());
  const cv::Size image_px = *is_of_whole ? part->whole_px : to_px;
  Result<LensParameters> scaled = scaled_calibration(std::move(lens), from_px, image_px, stretch, file_name, warnings);
  if (!scaled) return fail(scaled.error());
  if (*is_of_whole) {
    scaled->cx -= part->corner_px.x;
    scaled->cy -= part->corner_px.y;
    warnings.push_back({file_name, fmt::format("made for the whole footage, {}: its principal point is moved to the "
                                               "part of {} from ({}, {}) on",
                                               image_size_text(image_px), image_size_text(to_px), part->corner_px.x,
                                               part->corner_px.y)});
  }
  const LensModel made_of = scaled->model;
  Result<Lens> made = Lens::make(*std::move(scaled));
  // The matrix was correct before it was scaled: the coefficients are wrong, or scaling made a number infinite.
  const Field* coefficients = found(fields, kCoefficientNames);
  if (!made) {
    const bool is_other = *stated && **stated != made_of;
    return fail(coefficients != nullptr ? reader.where(*coefficients) : matrix,
                made.error().what + (is_other ? fmt::format("; the file says {}", traits_of(**stated).word) : ""));
  }
  for (const std::string& warning : matrix_warnings(made->parameters(), to_px, own_size_px->has_value()))
    warnings.push_back({matrix, warning});
  return Camera{.lens = *std::move(made), .size_px = to_px, .warnings = std::move(warnings)};
}

}  // namespace sigs::calibration

namespace sigs {

CalibrationName calibration_name(const std::filesystem::path& name) {
  const std::string text = name.string();
  const std::size_t at = text.rfind('#');
  std::error_code ignored;
  if (at == std::string::npos || text.find('/', at) != std::string::npos || std::filesystem::exists(name, ignored))
    return {name, ""};
  return {text.substr(0, at), text.substr(at + 1)};
}

Camera equirectangular_camera(cv::Size size_px) {
  const LensParameters lens{.model = LensModel::equirectangular,
                            .fx = size_px.width / (2 * std::numbers::pi),
                            .fy = size_px.height / std::numbers::pi,
                            .cx = (size_px.width - 1) / 2.0,
                            .cy = (size_px.height - 1) / 2.0};
  Camera camera{.lens = *Lens::make(lens), .size_px = size_px};
  if (size_px.width != 2 * size_px.height)
    camera.warnings.push_back(
        {"equirectangular", fmt::format("the image of {} is taken to cover 360 by 180 degrees, though it is not twice "
                                        "as wide as high",
                                        image_size_text(size_px))});
  return camera;
}

Result<Camera> read_calibration(const std::filesystem::path& path, std::optional<cv::Size> footage_size_px,
                                std::optional<LensModel> model, const std::optional<ImagePart>& part) {
  if (path.empty() && footage_size_px && !needs_calibration(model)) return equirectangular_camera(*footage_size_px);
  const CalibrationName name = calibration_name(path);
  const std::string file_name = name.file.filename().string();
  const Result<calibration::Fields> fields = calibration::fields_of_file(name.file);
  if (!fields) return fail(fields.error());
  const auto cameras = calibration::cameras_in(*fields, file_name);
  if (!cameras) return fail(cameras.error());
  const Result<std::size_t> index = calibration::chosen(*cameras, name);
  if (!index) return fail(index.error());
  Result<Camera> camera = calibration::camera_of((*cameras)[*index].fields, file_name, footage_size_px, model, part);
  // The left camera of a pair is the usual one; which of others is meant has to be said.
  const std::string& first = cameras->front().name;
  if (camera && cameras->size() > 1 && name.camera.empty() && first != "left")
    camera->warnings.push_back({file_name, fmt::format("describes {} cameras; read as {}: write {}#{} for the next",
                                                       cameras->size(), first, file_name, (*cameras)[1].name)});
  return camera;
}

}  // namespace sigs

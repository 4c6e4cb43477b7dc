// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "camera/calibration_formats.h"

namespace sigs::calibration {
namespace {

// A camera model of Kalibr that has parameters of its own before fu fv pu pv.
struct KalibrModel {
  std::string_view name;        // of camera_model
  std::string_view parameters;  // of the intrinsics
  std::string_view lens;        // of distortion_model here; empty: has xi beside the distortion of a pinhole
};

constexpr std::array<KalibrModel, 4> kKalibrModels{{{"pinhole", "", ""},
                                                    {"omni", "xi ", ""},
                                                    {"ds", "xi alpha ", "double_sphere"},
                                                    {"eucm", "alpha beta ", "extended_unified"}}};

// The fields with intrinsics as a camera matrix, and what goes before it as the keys of a file of one camera.
Result<Fields> with_matrix(Fields fields, const KalibrModel& model, const std::string& file_name) {
  const auto given = fields.find("intrinsics");
  if (given == fields.end()) return fields;
  const std::string name = given->second.name;
  if (const auto good = check_numbers(given->second, file_name); !good) return fail(good.error());
  std::vector<double> n = given->second.numbers;
  const auto own = std::ranges::count(model.parameters, ' ');
  if (std::ssize(n) != own + 4)
    return fail(file_name + ": " + name,
                fmt::format("expected {} numbers, {}fu fv pu pv, found {}", own + 4, model.parameters, n.size()));
  const auto first = n.begin() + own;
  fields.insert_or_assign("camera_matrix",
                          Field{.name = name, .numbers = {first[0], 0, first[2], 0, first[1], first[3], 0, 0, 1}});
  if (own == 0) return fields;
  Field before{.name = name, .numbers = {n.begin(), first}};
  const auto distortion = fields.find("distortion_model");
  const std::string named = distortion == fields.end() ? "none" : distortion->second.text;
  const bool is_sphere = model.lens.empty();
  if (named != "none" && !(is_sphere && named == "radtan"))
    return fail(file_name + ": " + distortion->second.name,
                fmt::format("'{}' is not supported with {}; {} is", named, model.name,
                            is_sphere ? "radtan, or none," : "none"));
  const auto unused = fields.find("distortion_coeffs");
  const auto is_zero = [](double number) { return number == 0; };
  if (named == "none" && unused != fields.end() && !std::ranges::all_of(unused->second.numbers, is_zero))
    return fail(file_name + ": " + unused->second.name, "has coefficients, though distortion_model is none");
  if (is_sphere) {
    if (named == "none") fields.insert_or_assign("distortion_coefficients", Field{.name = name});
    fields.insert_or_assign("xi", std::move(before));
  } else {
    fields.insert_or_assign("distortion_coefficients", std::move(before));
    fields.insert_or_assign("distortion_model", Field{.name = name, .text = std::string(model.lens)});
  }
  return fields;
}

}  // namespace

Result<Fields> from_kalibr(Fields fields, const std::string& prefix, const std::string& file_name) {
  if (!prefix.empty())
    for (auto& [key, field] : fields) field.name = prefix + field.name;
  KalibrModel model = kKalibrModels.front();
  if (const auto stated = fields.find("camera_model"); stated != fields.end()) {
    const auto* const known = std::ranges::find(kKalibrModels, stated->second.text, &KalibrModel::name);
    if (known == kKalibrModels.end())
      return fail(file_name + ": " + stated->second.name,
                  fmt::format("camera model '{}' is not known; pinhole, omni, ds and eucm are", stated->second.text));
    model = *known;
  }
  if (!fields.contains("camera_matrix")) {
    Result<Fields> with = with_matrix(std::move(fields), model, file_name);
    if (!with) return fail(with.error());
    fields = *std::move(with);
  }
  if (const auto size = fields.find("resolution"); size != fields.end() && !fields.contains("image_size"))
    fields.insert_or_assign("image_size", Field(size->second));
  return fields;
}

}  // namespace sigs::calibration

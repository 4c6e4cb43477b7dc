// SPDX-License-Identifier: MIT
#include "cli/commands.h"

#include <array>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "base/numbered_files.h"
#include "base/paths.h"
#include "base/pose.h"
#include "base/text.h"
#include "camera/camera.h"
#include "cli/options.h"
#include "mesh/mesh.h"
#include "project/json.h"
#include "video/color_space.h"
#include "video/frame_source.h"

namespace sigs::cli {

namespace {

constexpr std::array kLayoutNames{"gray", "Y'CbCr 4:2:0", "Y'CbCr 4:2:2", "Y'CbCr 4:4:4", "RGB"};
static_assert(kLayoutNames.size() == static_cast<std::size_t>(PixelLayout::rgb) + 1);
constexpr std::array kMatrixNames{"BT.601", "BT.709", "BT.2020"};
static_assert(kMatrixNames.size() == static_cast<std::size_t>(ColorMatrix::bt2020) + 1);
constexpr std::array kSiteNames{"left", "midway", "top left"};
static_assert(kSiteNames.size() == static_cast<std::size_t>(ChromaSite::top_left) + 1);

template <std::size_t N, class Enum>
const char* name_in(const std::array<const char*, N>& names, Enum value) {
  return names[static_cast<std::size_t>(value)];
}

// The transfer function used for the footage, where it differs from the stated one.
const char* curve_of(int transfer) {
  const TransferFunction used = transfer_function_of(transfer).value_or(TransferFunction::srgb);
  if (used == TransferFunction::srgb) return " (sRGB's curve is used)";
  return used == TransferFunction::pq || used == TransferFunction::hlg ? " (an intruder's white is 203 cd/m2)" : "";
}

// To the end of the last frame, whose duration follows from the nominal rate.
double length_s(const VideoInfo& video) {
  const double last_s = video.times_s.empty() ? 0.0 : video.times_s.back();
  return last_s + double(video.frame_rate_den) / video.frame_rate_num;
}

void print_video(const VideoInfo& video) {
  std::printf("video: %s, %s, %s (%s), container %s\n", video.codec.c_str(), image_size_text(video.size_px).c_str(),
              name_in(kLayoutNames, video.layout), video.pixel_format.c_str(), video.container.c_str());
  if (video.bit_depth > 8) std::printf("bits a sample: %d\n", video.bit_depth);
  if (!video.conversion.empty()) std::printf("conversion: %s\n", video.conversion.c_str());
  if (!video.projection.empty()) std::printf("360 degree footage: %s\n", video.projection.c_str());
  std::printf("frames: %d, %d/%d a second%s, %.3f s\n", video.frame_count(), video.frame_rate_num, video.frame_rate_den,
              video.variable_frame_rate ? " (variable)" : "", length_s(video));
  std::printf("color: %s range%s, matrix %s%s\n", video.color.range == ColorRange::full ? "full" : "limited",
              video.color.range_stated ? "" : " (assumed)", name_in(kMatrixNames, video.color.matrix),
              video.color.matrix_stated ? "" : " (assumed)");
  if (video.layout == PixelLayout::yuv420 || video.layout == PixelLayout::yuv422)
    std::printf("chroma: %s\n", name_in(kSiteNames, video.color.chroma_site));
  std::printf("light: transfer %s%s, primaries %s%s\n", transfer_name(video.color.transfer).c_str(),
              curve_of(video.color.transfer), primaries_name(video.color.primaries).c_str(),
              video.color.primaries == 2 || !from_bt709(video.color.primaries) ? " (BT.709's are used)" : "");
  for (const Warning& warning : video.warnings) print_warning(warning);
}

void print_camera(const Camera& camera) {
  const LensParameters& lens = camera.lens.parameters();
  std::printf("calibration: %s%s, %zu coefficients%s\n", name_of(lens.model), is_fisheye(lens.model) ? " fisheye" : "",
              lens.coefficients.size(), camera.lens.is_pinhole() ? " (a plain pinhole)" : "");
  std::printf("size: %s\n", image_size_text(camera.size_px).c_str());
  std::printf("fx fy cx cy: %.6g %.6g %.6g %.6g px\n", lens.fx, lens.fy, lens.cx, lens.cy);
  std::printf("coefficients:");
  const auto names = traits_of(lens.model).coefficient_names;
  for (std::size_t i = 0; i < lens.coefficients.size(); ++i)
    std::printf("%s %s %.9g", i > 0 ? "," : "", std::string(names[i]).c_str(), lens.coefficients[i]);
  std::printf("\nvalid field: up to %.2f degrees from the axis\n", deg_of_rad(camera.lens.valid_angle_rad()));
  const cv::Size size = camera.size_px;
  int unreachable = 0;
  for (const glm::dvec2 corner : {glm::dvec2(0, 0), glm::dvec2(size.width - 1, 0), glm::dvec2(0, size.height - 1),
                                  glm::dvec2(size.width - 1, size.height - 1)})
    unreachable += camera.lens.ray(corner) ? 0 : 1;
  if (unreachable > 0) std::printf("corners of the image without a ray: %d of 4\n", unreachable);
  for (const Warning& warning : camera.warnings) print_warning(warning);
}

void print_mesh(const Mesh& mesh) {
  const glm::vec3 size = mesh.high_m - mesh.low_m;
  std::printf("model: %zu triangles, %zu vertices, %zu materials\n", mesh.indices.size() / 3, mesh.vertices.size(),
              mesh.materials.size());
  std::printf("extent along x y z of the file, in its units: %.4g %.4g %.4g\n", size.x, size.y, size.z);
  for (const Material& material : mesh.materials) {
    std::printf("material %s: color %.3g %.3g %.3g, opacity %.3g%s\n", material.name.c_str(), material.diffuse.x,
                material.diffuse.y, material.diffuse.z, material.opacity, material.texture.empty() ? "" : ", textured");
    if (const std::optional<Rotor>& rotor = material.rotor)
      std::printf("  rotor: %d blades, %.4g rpm, radii %.4g to %.4g, chords %.3g to %.3g\n", rotor->blade_count,
                  rotor->rpm, rotor->root_m, rotor->tip_m, rotor->root_chord_m, rotor->tip_chord_m);
  }
  for (const std::string& name : mesh.group_names) std::printf("group or object %s\n", name.c_str());
  for (const Warning& warning : mesh.warnings) print_warning(warning);
}

Result<void> info_of_calibration(const std::filesystem::path& path, const std::string& size_text) {
  const Result<std::optional<cv::Size>> size = size_of_option(size_text);
  if (!size) return fail(size.error());
  if (read_project(path)) return fail(path.string(), "is a SIGS project; `sigs check` looks at it", ErrorKind::usage);
  const Result<Camera> camera = read_calibration(path, *size);
  if (!camera) return fail(camera.error());
  print_camera(*camera);
  return {};
}

struct InfoOptions {
  std::filesystem::path path;
  std::string size;
};

Result<void> info(const InfoOptions& options) {
  const std::filesystem::path& path = options.path;
  const std::filesystem::path file = calibration_name(path).file;
  std::error_code code;
  if (!std::filesystem::exists(file, code) && !is_number_pattern(path))
    return fail(path.string(), "no such file", ErrorKind::cannot_read);
  const std::string extension = lower_extension(file);
  if (extension == ".obj") {
    const Result<Mesh> mesh = read_obj(path);
    if (!mesh) return fail(mesh.error());
    print_mesh(*mesh);
    return {};
  }
  if (extension == ".xml" || extension == ".yml" || extension == ".yaml" || extension == ".json")
    return info_of_calibration(path, options.size);
  const Result<FrameSource> video = FrameSource::open(path);
  if (!video) return fail(video.error());
  print_video(video->info());
  return {};
}

}  // namespace

Command add_info_command(CLI::App& program) {
  CLI::App* const command = program.add_subcommand("info", "say what is read in a video, calibration or model");
  const auto options = std::make_shared<InfoOptions>();
  command->add_option("FILE", options->path, "a video, a calibration (xml, yml, yaml, json) or a model (obj)")
      ->required();
  add_value(*command, "--size", options->size, "WxH", "of the footage, for a calibration that states none or another");
  return [options] { return info(*options); };
}

}  // namespace sigs::cli

// SPDX-License-Identifier: MIT
#include "first_project/first_camera.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/pose.h"
#include "base/text.h"
#include "base/xml_text.h"

namespace sigs {

namespace {

constexpr double kMinFov_deg = 1;
constexpr double kMaxFov_deg = 359;
const std::string kStateFov = "--fov states it if you know it; ";
const std::string kMeasure = "`sigs calibrate` measures the lens";

double pixel_aspect(const VideoInfo& video) {
  return double(video.pixel_aspect_num) / video.pixel_aspect_den;
}

// Focal length, in the unit of half_size, of an image that ends at half_size at this angle from the axis.
double focal_length(double half_size, double half_angle_rad, bool is_fisheye) {
  return is_fisheye ? half_size / half_angle_rad : half_size / std::tan(half_angle_rad);
}

// A lens without distortion, of equal angles a pixel if it is a fisheye, with its axis in the middle of the image.
//   focal  in heights of a pixel
LensParameters plain_lens(const VideoInfo& video, double focal, bool is_fisheye) {
  LensParameters lens;
  lens.model = is_fisheye ? LensModel::kannala_brandt : LensModel::brown_conrady;
  lens.fx = focal / pixel_aspect(video);
  lens.fy = focal;
  lens.cx = (video.size_px.width - 1) / 2.0;
  lens.cy = (video.size_px.height - 1) / 2.0;
  lens.coefficients.assign(is_fisheye ? 4 : 5, 0.0);
  return lens;
}

struct GuessedLens {
  LensParameters lens;
  std::string how;          // "a pinhole of 70 degrees from side to side"
  bool is_default = false;  // nothing tells it
};

// The lens of a field of view along a length of the image, in heights of a pixel.
GuessedLens lens_of(const VideoInfo& video, double length, double fov_rad, bool is_fisheye, const std::string& across) {
  GuessedLens guessed{.lens = plain_lens(video, focal_length(length / 2, fov_rad / 2, is_fisheye), is_fisheye)};
  guessed.how = fmt::format("{} of {:.4g} degrees {}", is_fisheye ? "an equidistant fisheye" : "a pinhole",
                            deg_of_rad(fov_rad), across);
  return guessed;
}

// A pinhole of that field of view along the image's longer side.
GuessedLens default_lens(const VideoInfo& video, double fov_rad) {
  const double width = video.size_px.width * pixel_aspect(video), height = video.size_px.height;
  return lens_of(video, std::max(width, height), fov_rad, false,
                 width >= height ? "from side to side" : "from top to bottom");
}

GuessedLens guessed_lens(const FirstProjectOptions& options, const VideoInfo& video,
                         const std::optional<LoggedLens>& logged, FirstProjectNote& note) {
  const double width = video.size_px.width * pixel_aspect(video);
  const double height = video.size_px.height;
  const auto finish = [&](GuessedLens guessed, const std::string& why) {
    note.text = guessed.how + ", " + why;
    return guessed;
  };
  note.is_guess = true;
  note.remedy = kMeasure;
  if (options.horizontal_fov_deg) {
    const double fov_deg = *options.horizontal_fov_deg;
    return finish(lens_of(video, width, rad_of_deg(fov_deg), fov_deg >= kFisheyeFov_deg, "from side to side"),
                  "as asked for; distortion is not known");
  }
  if (logged && logged->diagonal_fov_rad && *logged->diagonal_fov_rad < rad_of_deg(kMaxFov_deg)) {
    const bool is_fisheye = logged->is_fisheye || *logged->diagonal_fov_rad >= rad_of_deg(kFisheyeFov_deg);
    return finish(
        lens_of(video, std::hypot(width, height), *logged->diagonal_fov_rad, is_fisheye, "along the diagonal"),
        "by what the file states (" + logged->source + "); distortion is not known");
  }
  if (logged && logged->horizontal_fov_rad && *logged->horizontal_fov_rad < rad_of_deg(kMaxFov_deg)) {
    const bool is_fisheye = logged->is_fisheye || *logged->horizontal_fov_rad >= rad_of_deg(kFisheyeFov_deg);
    return finish(lens_of(video, width, *logged->horizontal_fov_rad, is_fisheye, "from side to side"),
                  "by what the file states (" + logged->source + "); distortion is not known");
  }
  note.remedy = kStateFov + note.remedy;
  GuessedLens guessed = default_lens(video, rad_of_deg(kGuessedFov_deg));
  guessed.is_default = true;
  return finish(std::move(guessed), "a guess: nothing in the file tells it");
}

std::string calibration_xml(const LensParameters& lens, cv::Size size_px, const std::string& note) {
  std::string coefficients;
  for (const double coefficient : lens.coefficients)
    coefficients += (coefficients.empty() ? "" : " ") + exact_text(coefficient);
  // A comment may not hold two hyphens.
  std::string comment = note;
  for (std::size_t at = comment.find("--"); at != std::string::npos; at = comment.find("--")) comment.erase(at, 1);
  return fmt::format(
      "<?xml version=\"1.0\"?>\n<!-- Not measured: {}. -->\n<opencv_storage>\n<image_width>{}</image_width>\n"
      "<image_height>{}</image_height>\n<fisheye_model>{}</fisheye_model>\n"
      "<camera_matrix type_id=\"opencv-matrix\">\n  <rows>3</rows>\n  <cols>3</cols>\n  <dt>d</dt>\n  <data>\n"
      "    {} 0. {}\n    0. {} {}\n    0. 0. 1.</data></camera_matrix>\n"
      "<distortion_coefficients type_id=\"opencv-matrix\">\n  <rows>{}</rows>\n  <cols>1</cols>\n  <dt>d</dt>\n"
      "  <data>\n    {}</data></distortion_coefficients>\n</opencv_storage>\n",
      comment, size_px.width, size_px.height, lens.model == LensModel::kannala_brandt ? 1 : 0, exact_text(lens.fx),
      exact_text(lens.cx), exact_text(lens.fy), exact_text(lens.cy), lens.coefficients.size(), coefficients);
}

FirstCamera camera_of(const VideoInfo& video, const GuessedLens& guessed, Lens lens, FirstProjectNote note) {
  std::string text = calibration_xml(guessed.lens, video.size_px, note.text);
  return {.camera = {.lens = std::move(lens), .size_px = video.size_px},
          .calibration_text = std::move(text),
          .note = std::move(note),
          .is_default = guessed.is_default};
}

}  // namespace

Result<FirstCamera> first_camera(const FirstProjectOptions& options, const VideoInfo& video,
                                 const std::optional<LoggedLens>& logged) {
  FirstProjectNote note{.field = "footage.calibration"};
  if (!options.calibration.empty()) {
    Result<Camera> camera = read_calibration(options.calibration, video.size_px);
    if (!camera) return fail(camera.error());
    note.text = options.calibration.filename().string() + ", as given";
    return FirstCamera{.camera = *std::move(camera), .note = note};
  }
  if (options.horizontal_fov_deg &&
      !(*options.horizontal_fov_deg >= kMinFov_deg && *options.horizontal_fov_deg <= kMaxFov_deg))
    return fail("horizontal field of view", fmt::format("must be {} to {} degrees", kMinFov_deg, kMaxFov_deg),
                ErrorKind::usage);
  const GuessedLens guessed = guessed_lens(options, video, logged, note);
  Result<Lens> lens = Lens::make(guessed.lens);
  if (!lens) return fail(lens.error());
  return camera_of(video, guessed, *std::move(lens), std::move(note));
}

Result<FirstCamera> camera_by_turns(const VideoInfo& video, const FocalScale& seen) {
  const auto field_rad = [](double scale) { return 2 * std::atan(std::tan(rad_of_deg(kGuessedFov_deg) / 2) / scale); };
  const GuessedLens guessed = default_lens(video, field_rad(seen.value));
  FirstProjectNote note{.field = "footage.calibration", .is_guess = true};
  note.text = fmt::format("{}, by how the images turn ({} {:.0f}); distortion is not known", guessed.how,
                          seen.largest > 0 ? fmt::format("{:.0f} to", deg_of_rad(field_rad(seen.largest))) : "at most",
                          deg_of_rad(field_rad(seen.least)));
  note.remedy = kStateFov + kMeasure;
  Result<Lens> lens = Lens::make(guessed.lens);
  if (!lens) return fail(lens.error());
  return camera_of(video, guessed, *std::move(lens), std::move(note));
}

}  // namespace sigs

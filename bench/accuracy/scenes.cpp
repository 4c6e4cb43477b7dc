// SPDX-License-Identifier: MIT
#include "accuracy/scenes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <numbers>

#include "accuracy/csv.h"
#include "camera/calibration_text.h"
#include "camera/camera.h"
#include "project/project.h"
#include "scene/opened_project.h"
#include "scene/scene_at.h"
#include "scene/scene_files.h"
#include "truth/measure.h"

namespace sigs::accuracy {

namespace {

namespace fs = std::filesystem;

const fs::path kAssets = SIGS_ASSETS_DIR;
constexpr int kSteps = 12;  // iterations to the wanted size; at a distance each squares the relative error

Recipe sample_view(const std::string& name, const std::string& title, double size_px) {
  return {.name = name, .title = title, .size_px = size_px, .lens = sample_lens()};
}

// Everything but where the intruder is.
Project bare_project(const Recipe& recipe, const fs::path& folder) {
  Project project{.file = folder / (recipe.name + ".json"), .name = recipe.name};
  std::ofstream(folder / "footage.mkv") << "stands in for footage";
  std::ofstream(folder / (recipe.name + ".xml"))
      << calibration_xml({.lens = recipe.lens, .size_px = kImageSize_px, .comment = "", .numbers = {}});
  project.footage.video = "footage.mkv";
  project.footage.calibration = recipe.name + ".xml";
  if (recipe.has_own_body) project.footage.own_body_mask = (kAssets / "footage/sample_own_body.png").string();
  IntruderSettings intruder{.name = recipe.aircraft};
  intruder.model.file = (kAssets / "models" / recipe.aircraft / (recipe.aircraft + ".obj")).string();
  project.intruders.push_back(intruder);
  if (recipe.in_sun) {
    project.light.kind = LightKind::sun;
    project.light.sun = {.azimuth_deg = 120, .elevation_deg = 40};
  }
  return project;
}

void place(Project& project, const Recipe& recipe, const glm::dvec3& ray, double distance_m) {
  const glm::dvec3 middle_m = project.camera.position_m + ray * distance_m;  // the camera's attitude is zero
  const glm::dvec3 step_m = 2.0 * glm::normalize(recipe.flies_along);
  project.intruders[0].trajectory.waypoints = {{.frame = kFrame - 1, .position_m = middle_m - step_m},
                                               {.frame = kFrame + 1, .position_m = middle_m + step_m}};
  project.compositing.blur_px_per_m = recipe.sigma_px ? *recipe.sigma_px / distance_m : kPaperBlur_px_per_m;
  project.appearance.psf_sigma_px = 0;
}

Scene opened(const Project& project, SceneFiles& files) {
  const FootageShape footage{.size_px = kImageSize_px, .times_s = {0, 0.04, 0.08}};
  Result<Scene> scene = open_scene(project, footage, files);
  if (!scene) stop(scene.error().text());
  return std::move(*scene);
}

// Longer side of the silhouette's box.
double size_in(const Scene& scene) {
  const SceneMoment moment = scene_at(scene, kFrame);
  const auto silhouette =
      silhouette_of(scene.models[0]->points_m, moment.intruders[0].camera_from_body, scene.camera.lens);
  if (!silhouette) stop("an intruder without image");
  return std::max(silhouette->box.width, silhouette->box.height);
}

}  // namespace

LensParameters sample_lens() {
  const Result<Camera> camera = read_calibration(kAssets / "calibrations/sample.xml");
  if (!camera) stop(camera.error().text());
  return camera->lens.parameters();
}

LensParameters fisheye_170_lens() {
  // Half the width is 85 degrees from the axis.
  const double theta = 85 * std::numbers::pi / 180;
  const std::vector<double> k{-0.015, 0.003, -0.0012, 0.0001};
  const double square = theta * theta;
  const double distorted = theta * (1 + square * (k[0] + square * (k[1] + square * (k[2] + square * k[3]))));
  const double focal_px = 640 / distorted;
  return {LensModel::kannala_brandt, focal_px, focal_px, 639.5, 479.5, k};
}

LensParameters tangential_lens() {
  return {LensModel::brown_conrady, 900, 900, 639.5, 479.5, {-0.1, 0.02, 0.05, -0.08, 0}};
}

LensParameters pincushion_lens() {
  return {LensModel::brown_conrady, 900, 900, 639.5, 479.5, {0.15, 0.02, 0, 0, 0}};
}

std::vector<Recipe> recipes() {
  std::vector<Recipe> all;
  for (const bool is_airliner : {false, true})
    for (const auto& [name, size_px] : {std::pair{"near", 400.0}, {"mid", 60.0}, {"far", 8.0}}) {
      const std::string px = ": " + std::to_string(static_cast<int>(size_px)) + " px";
      all.push_back(sample_view(name + std::string(is_airliner ? "-airliner" : ""),
                                name + px + (is_airliner ? "; airliner" : ""), size_px));
      if (is_airliner) all.back().aircraft = "airliner";
    }
  all.push_back(sample_view("mid-soft", "mid: 60 px; sigma 2 px", 60));
  all.back().sigma_px = 2;
  all.push_back(sample_view("speck", "speck: 0.7 px; no blur", 0.7));
  all.back().sigma_px = 0;
  all.push_back({.name = "fisheye-edge",
                 .title = "edge of a 170 degree fisheye: 60 px",
                 .lens = fisheye_170_lens(),
                 .pixel = {1190, 330}});
  all.push_back(
      {.name = "tangential", .title = "strong tangential lens: 60 px", .lens = tangential_lens(), .pixel = {930, 660}});
  // A barrel's borders lie outside the undistorted image, where classic draws nothing.
  all.push_back(sample_view("border", "across the border: 150 px", 150));
  all.back().lens = pincushion_lens();
  all.back().pixel = {24, 350};
  all.back().flies_along = {-1, 0.1, 0};
  all.push_back(sample_view("own-body", "half behind the own body: 100 px", 100));
  all.back().pixel = {645, 826};
  all.back().has_own_body = true;
  return all;
}

Scene made_scene(const Recipe& recipe, const fs::path& folder) {
  const Result<Lens> lens = Lens::make(recipe.lens);
  if (!lens) stop(lens.error().text());
  const auto ray = lens->ray(recipe.pixel);
  if (!ray) stop(recipe.name + ": no ray");
  Project project = bare_project(recipe, folder);
  SceneFiles files;
  double distance_m = 10 * lens->pixels_per_radian(*ray) / recipe.size_px;
  for (int step = 0;; ++step) {
    place(project, recipe, *ray, distance_m);
    Scene scene = opened(project, files);
    const double size_px = size_in(scene);
    if (step == kSteps || std::abs(size_px / recipe.size_px - 1) < 1e-6) return scene;
    distance_m *= size_px / recipe.size_px;
  }
}

namespace {

constexpr int kGrain = 3;  // code values to either side

// -kGrain..kGrain, the same for the same place in every run.
int grain(int x, int y, int plane) {
  std::uint32_t hash = static_cast<std::uint32_t>(x) * 0x9E3779B1U ^ static_cast<std::uint32_t>(y) * 0x85EBCA77U ^
                       static_cast<std::uint32_t>(plane) * 0xC2B2AE3DU;
  hash ^= hash >> 15;
  hash *= 0x2C1B3C6DU;
  hash ^= hash >> 13;
  return static_cast<int>(hash % (2 * kGrain + 1)) - kGrain;
}

// From blue above through haze to green, with a soft horizon half-way down.
double smooth_code(double down, std::size_t plane) {
  constexpr std::array<double, 3> kOverhead{92, 132, 188};
  constexpr std::array<double, 3> kHaze{188, 200, 212};
  constexpr std::array<double, 3> kGround{84, 96, 62};
  const double sky = kOverhead[plane] + (kHaze[plane] - kOverhead[plane]) * std::min(2 * down, 1.0);
  const double is_ground = 1 / (1 + std::exp(-(down - 0.52) / 0.01));
  return sky + (kGround[plane] - sky) * is_ground;
}

}  // namespace

Frame background(cv::Size size_px) {
  Frame frame{.layout = PixelLayout::rgb, .color = {.range = ColorRange::full}};
  for (std::size_t plane = 0; plane < 3; ++plane) {
    frame.planes[plane] = cv::Mat(size_px, CV_8UC1);
    for (int y = 0; y < size_px.height; ++y) {
      const double smooth = smooth_code((y + 0.5) / size_px.height, plane);
      for (int x = 0; x < size_px.width; ++x)
        frame.planes[plane].at<uchar>(y, x) = cv::saturate_cast<uchar>(smooth + grain(x, y, static_cast<int>(plane)));
    }
  }
  return frame;
}

}  // namespace sigs::accuracy

// SPDX-License-Identifier: MIT
// Footage in 4:2:0 against the truth averaged to 4:2:0 where the footage has its chroma: chroma.csv.
//   bench_accuracy_chroma FOLDER [quick]

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <vector>

#include "accuracy/background.h"
#include "accuracy/csv.h"
#include "accuracy/errors.h"
#include "accuracy/runner.h"
#include "accuracy/scenes.h"
#include "frame/compose_frame.h"
#include "video/color_space.h"

namespace sigs::accuracy {

namespace {

using Planes = std::array<cv::Mat, 3>;  // CV_64FC1: luma, and chroma averaged

struct Site {
  const char* name;
  ChromaSite site;
};
constexpr Site kSites[] = {
    {"left", ChromaSite::left}, {"midway", ChromaSite::center}, {"top left", ChromaSite::top_left}};

// The site's weights, written out again: one axis, edges repeated.
double averaged(const auto& value, int chroma, int last, bool on_pixel) {
  const auto at = [&](int i) { return value(std::clamp(i, 0, last)); };
  if (on_pixel) return 0.25 * at(2 * chroma - 1) + 0.5 * at(2 * chroma) + 0.25 * at(2 * chroma + 1);
  return 0.5 * at(2 * chroma) + 0.5 * at(2 * chroma + 1);
}

Planes planes_of_rgb(const cv::Mat& rgb, const ColorInfo& color) {
  const CodeToRgb map = code_to_rgb(PixelLayout::yuv420, color);
  Planes planes;
  std::array<cv::Mat, 3> whole;
  for (int plane = 0; plane < 3; ++plane) {
    cv::Mat& codes = whole[static_cast<std::size_t>(plane)];
    codes.create(rgb.size(), CV_64FC1);
    for (int y = 0; y < rgb.rows; ++y)
      for (int x = 0; x < rgb.cols; ++x) {
        const cv::Vec3d& pixel = rgb.at<cv::Vec3d>(y, x);
        double sum = map.offset[plane];
        for (int c = 0; c < 3; ++c) sum += map.from_rgb(plane, c) * pixel[c] / 255;
        codes.at<double>(y, x) = sum;
      }
  }
  planes[0] = whole[0];
  const bool on_column = color.chroma_site != ChromaSite::center;
  const bool on_row = color.chroma_site == ChromaSite::top_left;
  for (std::size_t plane = 1; plane < 3; ++plane) {
    planes[plane].create((rgb.rows + 1) / 2, (rgb.cols + 1) / 2, CV_64FC1);
    for (int j = 0; j < planes[plane].rows; ++j)
      for (int i = 0; i < planes[plane].cols; ++i)
        planes[plane].at<double>(j, i) = averaged(
            [&](int y) {
              return averaged([&](int x) { return whole[plane].at<double>(y, x); }, i, rgb.cols - 1, on_column);
            },
            j, rgb.rows - 1, on_row);
  }
  return planes;
}

// The plain reference: chroma read from the block's own sample, which moves by the mean of what its pixels' chroma
// moves by, wherever it lies.
void blend_by_blocks(Frame& frame, const Layer& layer) {
  const CodeToRgb map = code_to_rgb(frame.layout, frame.color);
  const TransferCurve curve(TransferFunction::srgb);
  const Frame before = cloned(frame);
  cv::Mat moved(frame.planes[1].size(), CV_32FC2, cv::Scalar::all(0));
  for (int y = layer.rect.y; y < layer.rect.br().y; ++y)
    for (int x = layer.rect.x; x < layer.rect.br().x; ++x) {
      const cv::Vec4f& color = layer.color.at<cv::Vec4f>(y - layer.rect.y, x - layer.rect.x);
      if (!(color[3] > 0)) continue;
      const cv::Vec3f old_code(before.planes[0].at<uchar>(y, x), before.planes[1].at<uchar>(y / 2, x / 2),
                               before.planes[2].at<uchar>(y / 2, x / 2));
      cv::Vec3f rgb = map.to_rgb * (old_code - map.offset);
      for (int c = 0; c < 3; ++c)
        rgb[c] = curve.display_of_linear(color[c] + (1 - color[3]) * curve.linear_of_display(rgb[c]));
      const cv::Vec3f code = map.from_rgb * rgb + map.offset;
      frame.planes[0].at<uchar>(y, x) = cv::saturate_cast<uchar>(code[0]);
      moved.at<cv::Vec2f>(y / 2, x / 2) += 0.25F * cv::Vec2f(code[1] - old_code[1], code[2] - old_code[2]);
    }
  for (int plane = 1; plane < 3; ++plane) {
    cv::Mat& chroma = frame.planes[static_cast<std::size_t>(plane)];
    for (int y = 0; y < chroma.rows; ++y)
      for (int x = 0; x < chroma.cols; ++x)
        chroma.at<uchar>(y, x) =
            cv::saturate_cast<uchar>(static_cast<float>(chroma.at<uchar>(y, x)) + moved.at<cv::Vec2f>(y, x)[plane - 1]);
  }
}

struct PlaneErrors {
  double luma = 0;
  double chroma = 0;  // root mean squares
  double largest_chroma = 0;
};

PlaneErrors errors_of(const Frame& image, const Planes& truth, const cv::Rect& region) {
  PlaneErrors errors;
  const cv::Rect halved(region.x / 2, region.y / 2, region.width / 2, region.height / 2);
  double squares = 0;
  for (std::size_t plane = 0; plane < 3; ++plane) {
    const cv::Rect& part = plane == 0 ? region : halved;
    cv::Mat codes;
    image.planes[plane](part).convertTo(codes, CV_64F);
    const cv::Mat off = codes - truth[plane](part);
    if (plane == 0) {
      errors.luma = std::sqrt(off.dot(off) / static_cast<double>(off.total()));
      continue;
    }
    squares += off.dot(off) / static_cast<double>(off.total());
    errors.largest_chroma = std::max(errors.largest_chroma, cv::norm(off, cv::NORM_INF));
  }
  errors.chroma = std::sqrt(squares / 2);
  return errors;
}

Frame rounded(const Planes& truth, const Frame& like) {
  Frame frame = cloned(like);
  for (std::size_t plane = 0; plane < 3; ++plane) truth[plane].convertTo(frame.planes[plane], CV_8U);
  return frame;
}

Layer layer_of(const Scene& scene, ComposeContext& context) {
  const SceneMoment moment = scene_at(scene, kFrame);
  const Result<IntruderLayers> layers = intruder_layers(scene, moment, moment.intruders[0], context);
  if (!layers) stop(layers.error().text());
  return layers->occluded;
}

void measure(const Recipe& recipe, const Call& call, Benches& benches, Csv& csv) {
  const Frame sky = background(kImageSize_px);
  const Scene scene = made_scene(recipe, call.folder / "projects");
  const Standard standard = standard_of(scene, kFrame, sky, effort_of(call).samples_per_side);
  cv::Mat rgb;
  cv::merge(std::vector<cv::Mat>(sky.planes.begin(), sky.planes.end()), rgb);
  rgb.convertTo(rgb, CV_64F);
  standard.codes.copyTo(rgb(standard.region));
  const Runner runner = runners_of(scene, {Method{}}).front();
  for (const auto& [name, site] : kSites) {
    const Frame footage = frame_of_bgr(bgr_of(sky), PixelLayout::yuv420, {.chroma_site = site});
    const Planes truth = planes_of_rgb(rgb, footage.color);
    Frame by_blocks = cloned(footage);
    blend_by_blocks(by_blocks, layer_of(runner.scene, benches.of(runner.method)));
    const PlaneErrors before = errors_of(by_blocks, truth, standard.region);
    const PlaneErrors after = errors_of(composed(runner, footage, benches).image, truth, standard.region);
    const PlaneErrors floor = errors_of(rounded(truth, footage), truth, standard.region);
    csv.row(recipe.title, name, before.luma, after.luma, floor.luma, before.chroma, after.chroma, floor.chroma,
            before.largest_chroma, after.largest_chroma);
  }
  benches.forget(scene);
}

void measure_chroma(const Call& call, Benches& benches) {
  Csv csv(call.folder / "chroma.csv",
          "title,site,luma_by_blocks,luma,luma_rounded,chroma_by_blocks,chroma,chroma_rounded,max_by_blocks,max");
  for (const Recipe& recipe : recipes()) {
    std::printf("%s\n", recipe.title.c_str());
    std::fflush(stdout);
    measure(recipe, call, benches, csv);
  }
}

}  // namespace

}  // namespace sigs::accuracy

int main(int argc, char** argv) {
  using namespace sigs::accuracy;
  const Call call = call_of(argc, argv);
  std::filesystem::create_directories(call.folder / "projects");
  Benches benches;
  measure_chroma(call, benches);
  return 0;
}

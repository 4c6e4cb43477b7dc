// SPDX-License-Identifier: MIT
// Real aircraft of clips beside a drawn one in the same frame: how much livelier the image is in a ring around it than
// farther away, uncoded and by ways of coding it; what each way does to the background; what it costs.
//   bench_codec_match FOLDER CLIP...     FOLDER has CLIP.mp4 and CLIP_gt.csv
// x264 by the ffmpeg program codes the whole frame: "intra" as one image, "inter" after the footage's own frame as
// the image before at a fine QP.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <map>
#include <numeric>
#include <opencv2/imgproc.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "base/statistics.h"
#include "compositor/codec_match.h"
#include "video/frame_source.h"

namespace {

using namespace sigs;
namespace fs = std::filesystem;

// Boxes by frame: "frame,label,x,y,w,h", pixels counted from 1.
std::map<int, cv::Rect> boxes_in(const fs::path& path) {
  std::map<int, cv::Rect> boxes;
  std::ifstream file(path);
  std::string line;
  while (std::getline(file, line)) {
    std::istringstream fields(line);
    std::string frame, label, number;
    std::getline(fields, frame, ',');
    std::getline(fields, label, ',');
    std::vector<double> values;
    while (std::getline(fields, number, ',')) values.push_back(std::atof(number.c_str()));
    if (values.size() == 4 && std::isdigit(static_cast<unsigned char>(frame[0])) != 0)
      boxes[std::atoi(frame.c_str())] =
          cv::Rect(cvRound(values[0]) - 1, cvRound(values[1]) - 1, cvRound(values[2]), cvRound(values[3]));
  }
  return boxes;
}

// What stands out of the sky in a box, by more than `contrast` codes.
cv::Mat silhouette(const cv::Mat& luma, const cv::Rect& box, double contrast) {
  const cv::Rect around = cv::Rect(box.x - 12, box.y - 12, box.width + 24, box.height + 24) & cv::Rect({}, luma.size());
  std::vector<double> sky;
  for (int y = around.y; y < around.br().y; ++y)
    for (int x = around.x; x < around.br().x; ++x)
      if (!box.contains({x, y})) sky.push_back(luma.at<uchar>(y, x));
  cv::Mat off;
  cv::absdiff(luma, cv::Scalar(median(sky)), off);
  cv::Mat mask = cv::Mat::zeros(luma.size(), CV_8UC1);
  cv::Mat(off(box & around) > contrast).copyTo(mask(box & around));
  return mask;
}

struct Ring {
  double near = 0;  // root mean square of what differs from the mean of 3x3, at 4 to 9 px from the silhouette
  double far = 0;   // at 20 to 30 px
};

Ring ring_of(const cv::Mat& luma, const cv::Mat& mask) {
  cv::Mat values, smooth, distance;
  luma.convertTo(values, CV_32F);
  cv::blur(values, smooth, {3, 3});
  const cv::Mat detail = values - smooth;
  cv::distanceTransform(mask == 0, distance, cv::DIST_L2, 5);
  const auto rms = [&](double low, double high) {
    double sum = 0;
    int count = 0;
    for (int y = 0; y < luma.rows; ++y)
      for (int x = 0; x < luma.cols; ++x) {
        const float at = distance.at<float>(y, x);
        if (at < low || at > high) continue;
        sum += detail.at<float>(y, x) * detail.at<float>(y, x);
        ++count;
      }
    return std::sqrt(sum / std::max(count, 1));
  };
  return {rms(4, 9), rms(20, 30)};
}

// A dark figure with thin wings and a fin, as large as the box, edges blurred by 0.45 px.
void draw(Frame& frame, const cv::Rect& box, double contrast) {
  constexpr int kFine = 8;
  cv::Mat fine = cv::Mat::zeros(box.height * kFine, box.width * kFine, CV_32FC1);
  const cv::Point middle(fine.cols / 2, fine.rows / 2);
  cv::ellipse(fine, middle, {fine.cols * 48 / 100, fine.rows * 9 / 100}, 0, 0, 360, 1, -1);
  cv::ellipse(fine, middle, {fine.cols * 10 / 100, fine.rows * 46 / 100}, 15, 0, 360, 1, -1);
  cv::ellipse(fine, {fine.cols * 88 / 100, middle.y}, {fine.cols * 5 / 100, fine.rows * 22 / 100}, 0, 0, 360, 1, -1);
  cv::Mat opacity;
  cv::resize(fine, opacity, box.size(), 0, 0, cv::INTER_AREA);
  cv::copyMakeBorder(opacity, opacity, 4, 4, 4, 4, cv::BORDER_CONSTANT, 0);
  cv::GaussianBlur(opacity, opacity, {}, 0.45);
  for (int i = 0; i < frame.plane_count(); ++i) {
    const cv::Size step = i == 0 ? cv::Size(1, 1) : chroma_step(frame.layout);
    cv::Mat share;
    cv::resize(opacity, share, {opacity.cols / step.width, opacity.rows / step.height}, 0, 0, cv::INTER_AREA);
    const cv::Rect at((box.x - 4) / step.width, (box.y - 4) / step.height, share.cols, share.rows);
    cv::Mat plane = frame.planes[static_cast<std::size_t>(i)](at);
    cv::Mat values;
    plane.convertTo(values, CV_32F);
    values -= share * (i == 0 ? contrast : contrast * 0.06);
    values.convertTo(plane, CV_8U);
  }
}

void write_raw(std::ofstream& file, const Frame& frame) {
  for (int i = 0; i < frame.plane_count(); ++i) {
    const cv::Mat plane = frame.planes[static_cast<std::size_t>(i)].clone();
    file.write(reinterpret_cast<const char*>(plane.data), static_cast<std::streamsize>(plane.total()));
  }
}

cv::Mat x264_luma(const std::vector<const Frame*>& frames, const std::string& parameters) {
  const fs::path folder = fs::temp_directory_path();
  const cv::Size size = frames[0]->size_px();
  {
    std::ofstream raw(folder / "codec_match.raw", std::ios::binary);
    for (const Frame* frame : frames) write_raw(raw, *frame);
  }
  const std::string command = fmt::format(
      "ffmpeg -nostdin -v error -y -f rawvideo -pix_fmt yuv420p -s {}x{} -i {} -c:v libx264 -profile:v main "
      "-x264-params {} {}",
      size.width, size.height, (folder / "codec_match.raw").string(), parameters,
      (folder / "codec_match.mkv").string());
  if (std::system(command.c_str()) != 0) return {};  // NOLINT(concurrency-mt-unsafe)
  Result<FrameSource> source = FrameSource::open(folder / "codec_match.mkv");
  if (!source) return {};
  return source->read(static_cast<int>(frames.size()) - 1)->planes[0].clone();
}

struct Way {
  std::vector<double> near, excess, background_mse;
};

double sd_around(const cv::Mat& luma, const cv::Mat& mask, const cv::Rect& box) {
  const cv::Rect around = cv::Rect(box.x - 35, box.y - 35, box.width + 70, box.height + 70) & cv::Rect({}, luma.size());
  cv::Mat hidden;
  cv::dilate(mask, hidden, cv::Mat::ones(9, 9, CV_8UC1));
  cv::Scalar mean, sd;
  cv::meanStdDev(luma(around), mean, sd, hidden(around) == 0);
  return sd[0];
}

// A place for the drawing: of the same size, with a background as lively as that of the real one, which is not near.
// Empty: there is none.
cv::Rect free_place(const cv::Mat& luma, const cv::Mat& silhouette, const cv::Rect& real) {
  const double wanted = sd_around(luma, silhouette, real);
  cv::Rect best;
  double least = std::max(1.0, wanted * 0.5);
  for (int y = 40; y + real.height + 40 < luma.rows; y += 24)
    for (int x = 40; x + real.width + 40 < luma.cols; x += 24) {
      const cv::Rect place(x + (x / 24) % 7, y + (y / 24) % 5, real.width, real.height);
      const cv::Rect around(place.x - 35, place.y - 35, place.width + 70, place.height + 70);
      if ((around & cv::Rect({}, luma.size())) != around || !(around & real).empty()) continue;
      const double off = std::abs(sd_around(luma, silhouette, place) - wanted);
      if (off < least) best = place;
      least = std::min(least, off);
    }
  return best;
}

void add(Way& way, const cv::Mat& luma, const cv::Mat& footage, const cv::Mat& mask, const cv::Rect& place) {
  const Ring ring = ring_of(luma, mask);
  way.near.push_back(ring.near);
  way.excess.push_back(ring.near - ring.far);
  cv::Mat off, outside;
  cv::absdiff(luma, footage, off);
  off.convertTo(off, CV_32F);
  cv::Mat around = cv::Mat::zeros(luma.size(), CV_8UC1);
  around(cv::Rect(place.x - 32, place.y - 32, place.width + 64, place.height + 64) & cv::Rect({}, luma.size())) = 255;
  cv::dilate(mask, outside, cv::Mat::ones(9, 9, CV_8UC1));
  around.setTo(0, outside);
  way.background_mse.push_back(cv::mean(off.mul(off), around)[0]);
}

void print(const char* name, const Way& way) {
  const auto mean = [](const std::vector<double>& v) {
    return std::accumulate(v.begin(), v.end(), 0.0) / static_cast<double>(v.size());
  };
  const double mse = way.background_mse.empty() ? NAN : mean(way.background_mse);
  std::printf("%-14s %4zu %10.3f %10.3f %10.3f %14.1f\n", name, way.near.size(), mean(way.near), mean(way.excess),
              median(way.excess), 10 * std::log10(255 * 255 / mse));
}

}  // namespace

int main(int argc, char** argv) {
  std::map<std::string, Way> ways;
  double seconds = 0;
  int coded = 0;
  for (int i = 2; i < argc; ++i) {
    const fs::path clip = fs::path(argv[1]) / (std::string(argv[i]) + ".mp4");
    Result<FrameSource> source = FrameSource::open(clip, nullptr, Quantisers::read);
    if (!source) continue;
    const std::map<int, cv::Rect> boxes = boxes_in(fs::path(argv[1]) / (std::string(argv[i]) + "_gt.csv"));
    for (const int n : {60, 150, 240}) {
      const auto box = boxes.find(n);
      if (box == boxes.end() || n >= source->info().frame_count()) continue;
      const Frame footage = source->read(n).value();
      if (footage.layout != PixelLayout::yuv420 || box->second.width < 10) continue;
      const cv::Mat& luma = footage.planes[0];
      const cv::Mat real = silhouette(luma, box->second, 20);
      const cv::Rect place = free_place(luma, real, box->second);
      if (cv::countNonZero(real) < 15 || place.empty()) continue;
      cv::Mat off;
      cv::absdiff(luma, cv::Scalar(cv::mean(luma(box->second), real(box->second) == 0)[0]), off);
      const double contrast = cv::mean(off, real)[0];
      add(ways["1 real"], luma, luma, real, box->second);
      ways["1 real"].background_mse.clear();
      Frame drawn = cloned(footage);
      draw(drawn, place, contrast * 1.2);
      const cv::Mat mask = silhouette(drawn.planes[0], place, 20);
      add(ways["2 none"], drawn.planes[0], luma, mask, place);
      for (const int more : {0, 6}) {
        Frame ours = cloned(drawn);
        cv::Mat opacity = mask.clone();
        FrameQuantisers quantisers = *footage.quantisers;
        quantisers.blocks += more;
        const std::clock_t begin = std::clock();
        const cv::Rect reach(place.x - 4, place.y - 4, place.width + 8, place.height + 8);
        static_cast<void>(CodecMatch(footage, std::vector{reach}, quantisers).apply(ours, opacity, {}));
        seconds += static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
        ++coded;
        add(ways[more == 0 ? "3 residual" : "4 residual+6"], ours.planes[0], luma, mask, place);
      }
      const int qp = cvRound(footage.quantisers->mean);
      const cv::Mat intra = x264_luma({&drawn}, fmt::format("qp={}:ipratio=1:keyint=1:aq-mode=0", qp));
      if (!intra.empty()) add(ways["5 x264 intra"], intra, luma, mask, place);
      const cv::Mat inter =
          x264_luma({&footage, &drawn}, fmt::format("qp={}:ipratio={:.2f}:bframes=0:aq-mode=0:mbtree=0"
                                                    ":scenecut=0",
                                                    qp, std::exp2((qp - 2) / 6.0)));
      if (!inter.empty()) add(ways["6 x264 inter"], inter, luma, mask, place);
    }
  }
  std::printf("%-14s %4s %10s %10s %10s %14s\n", "way", "n", "ring", "- far", "median", "background dB");
  for (const auto& [name, way] : ways) print(name.c_str() + 2, way);
  std::printf("codec match: %.3f ms of a processor a target\n", 1000 * seconds / std::max(coded, 1));
}

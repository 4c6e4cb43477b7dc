// SPDX-License-Identifier: MIT
#include "realism/report.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "accuracy/csv.h"

namespace sigs::bench {

namespace {

constexpr int kPiece_px = 240;  // side of an enlarged target on the sheet
constexpr int kGap_px = 6;
constexpr int kText_px = 18;  // height of a line of text
const cv::Scalar kInk(40, 40, 40);

void write_text(cv::Mat& image, const std::string& text, cv::Point at) {
  cv::putText(image, text, at, cv::FONT_HERSHEY_SIMPLEX, 0.42, kInk, 1, cv::LINE_AA);
}

// Enlarged by whole factors, so that pixels stay squares; what is larger than a piece is shrunk.
cv::Mat piece_of(const cv::Mat& image) {
  cv::Mat large, piece(kPiece_px, kPiece_px, CV_8UC3, cv::Scalar::all(255));
  const int side = std::max(image.cols, image.rows);
  if (side <= kPiece_px)
    cv::resize(image, large, image.size() * (kPiece_px / side), 0, 0, cv::INTER_NEAREST);
  else
    cv::resize(image, large, {}, 1.0 * kPiece_px / side, 1.0 * kPiece_px / side, cv::INTER_AREA);
  const cv::Point at((kPiece_px - large.cols) / 2, (kPiece_px - large.rows) / 2);
  large.copyTo(piece(cv::Rect(at, large.size())));
  return piece;
}

void write_png(const std::filesystem::path& file, const cv::Mat& image) {
  if (!cv::imwrite(file.string(), image)) accuracy::stop(file.string() + ": cannot be written");
}

std::vector<double> values_of(const std::vector<Sample>& samples, const std::string& kind, const LookMeasure& measure) {
  std::vector<double> values;
  for (const Sample& sample : samples)
    if (const Target* const target = target_of(sample, kind))
      if (const auto value = target->look.*measure.value) values.push_back(*value);
  return values;
}

const cv::Scalar kColors[] = {{0, 0, 0}, {160, 160, 160}, {40, 40, 220}, {200, 120, 0}, {40, 160, 40}, {180, 40, 180}};

// One measure's distributions as lines over 24 classes between the real ones' outer percentiles, widened.
cv::Mat histogram_of(const std::vector<Sample>& samples, const std::vector<std::string>& kinds,
                     const LookMeasure& measure) {
  constexpr int kWidth_px = 300, kHeight_px = 130, kClasses = 24;
  cv::Mat panel(kHeight_px + 2 * kText_px, kWidth_px, CV_8UC3, cv::Scalar::all(255));
  write_text(panel, std::string(measure.name), {6, kText_px - 5});
  std::vector<double> all;
  for (const std::string& kind : kinds)
    for (const double value : values_of(samples, kind, measure)) all.push_back(value);
  if (all.size() < 10) return panel;
  std::sort(all.begin(), all.end());
  const double low = all[all.size() / 50], high = std::max(low + 1e-9, all[all.size() - 1 - all.size() / 50]);
  for (std::size_t k = 0; k < kinds.size(); ++k) {
    const std::vector<double> values = values_of(samples, kinds[k], measure);
    std::vector<double> share(kClasses, 0);
    for (const double value : values)
      share[static_cast<std::size_t>(std::clamp(static_cast<int>((value - low) / (high - low) * kClasses), 0,
                                                kClasses - 1))] += 1.0 / static_cast<double>(values.size());
    std::vector<cv::Point> line;
    for (int c = 0; c < kClasses; ++c)
      line.emplace_back(
          (2 * c + 1) * kWidth_px / (2 * kClasses),
          kText_px + static_cast<int>(kHeight_px * (1 - std::min(1.0, 2.5 * share[static_cast<std::size_t>(c)]))));
    cv::polylines(panel, line, false, kColors[k % std::size(kColors)], k == 0 ? 3 : 1, cv::LINE_AA);
  }
  write_text(panel, cv::format("%.3g", low), {4, kHeight_px + 2 * kText_px - 4});
  write_text(panel, cv::format("%.3g %s", high, std::string(measure.unit).c_str()),
             {kWidth_px - 90, kHeight_px + 2 * kText_px - 4});
  return panel;
}

}  // namespace

const Target* target_of(const Sample& sample, const std::string& kind) {
  const auto found = std::find_if(sample.targets.begin(), sample.targets.end(),
                                  [&](const Target& target) { return target.kind == kind; });
  return found == sample.targets.end() ? nullptr : &*found;
}

void draw_sheet(const std::vector<const Sample*>& samples, const std::vector<std::string>& kinds,
                const std::filesystem::path& file) {
  const int column_px = kPiece_px + kGap_px, row_px = kPiece_px + kText_px + kGap_px;
  cv::Mat sheet(kText_px + static_cast<int>(samples.size()) * row_px, static_cast<int>(kinds.size()) * column_px,
                CV_8UC3, cv::Scalar::all(255));
  for (std::size_t k = 0; k < kinds.size(); ++k) {
    const int x = static_cast<int>(k) * column_px;
    write_text(sheet, kinds[k], {x + 4, kText_px - 5});
    for (std::size_t s = 0; s < samples.size(); ++s) {
      const int y = kText_px + static_cast<int>(s) * row_px;
      const Target* const target = target_of(*samples[s], kinds[k]);
      if (target != nullptr) piece_of(target->image).copyTo(sheet(cv::Rect(x, y, kPiece_px, kPiece_px)));
      if (k == 0)
        write_text(
            sheet,
            cv::format("%s frame %d; %s", samples[s]->clip.c_str(), samples[s]->frame, samples[s]->model.c_str()),
            {x + 4, y + kPiece_px + kText_px - 5});
    }
  }
  write_png(file, sheet);
}

void draw_histograms(const std::vector<Sample>& samples, const std::vector<std::string>& kinds,
                     const std::filesystem::path& file) {
  std::vector<cv::Mat> panels;
  for (const LookMeasure& measure : look_measures()) panels.push_back(histogram_of(samples, kinds, measure));
  constexpr int kColumns = 4;
  const cv::Size size = panels.front().size();
  const int rows = (static_cast<int>(panels.size()) + kColumns - 1) / kColumns;
  cv::Mat image(rows * size.height + kText_px, kColumns * size.width, CV_8UC3, cv::Scalar::all(255));
  for (std::size_t k = 0; k < kinds.size(); ++k)
    cv::putText(image, kinds[k], {10 + 150 * static_cast<int>(k), kText_px - 5}, cv::FONT_HERSHEY_SIMPLEX, 0.5,
                kColors[k % std::size(kColors)], 1, cv::LINE_AA);
  for (std::size_t i = 0; i < panels.size(); ++i) {
    const int n = static_cast<int>(i);
    panels[i].copyTo(image(cv::Rect({n % kColumns * size.width, kText_px + n / kColumns * size.height}, size)));
  }
  write_png(file, image);
}

}  // namespace sigs::bench

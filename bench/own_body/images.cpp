// SPDX-License-Identifier: MIT
#include <algorithm>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "finding.h"
#include "measures.h"

namespace sigs::bench {

namespace {

constexpr int kCard_px = 300;  // width of an image on a sheet
const cv::Scalar kCard(250, 252, 252), kInk(61, 54, 48);

// An image with a line of text below it.
cv::Mat titled(const cv::Mat& image, const std::string& title) {
  const cv::Size size_px(kCard_px, kCard_px * image.rows / image.cols);
  constexpr int kText_px = 26;
  cv::Mat card(size_px.height + kText_px, size_px.width + 8, CV_8UC3, kCard), bgr = image;
  if (image.channels() == 1) cv::cvtColor(image, bgr, cv::COLOR_GRAY2BGR);
  cv::resize(bgr, card(cv::Rect({0, 0}, size_px)), size_px, 0, 0, cv::INTER_AREA);
  cv::putText(card, title, {2, size_px.height + 18}, cv::FONT_HERSHEY_SIMPLEX, 0.45, kInk, 1, cv::LINE_AA);
  return card;
}

cv::Mat rows_of(const std::vector<cv::Mat>& cards, int columns) {
  cv::Mat sheet;
  for (std::size_t i = 0; i < cards.size(); i += static_cast<std::size_t>(columns)) {
    cv::Mat row;
    for (std::size_t k = i; k < i + static_cast<std::size_t>(columns); ++k) {
      const cv::Mat card = k < cards.size() ? cards[k] : cv::Mat(cards[0].size(), CV_8UC3, kCard);
      row.empty() ? card.copyTo(row) : cv::hconcat(row, card, row);
    }
    sheet.empty() ? row.copyTo(sheet) : cv::vconcat(sheet, row, sheet);
  }
  return sheet;
}

void write_jpeg(const std::filesystem::path& path, const cv::Mat& image) {
  if (!cv::imwrite(path.string(), image, {cv::IMWRITE_JPEG_QUALITY, 85}))
    accuracy::stop(path.string() + ": cannot be written");
}

// From the output of measure_flights.
void draw_flights(const flights::FlightSettings& making, const accuracy::Call& call) {
  std::vector<cv::Mat> cards;
  for (const std::string& name : flights::names()) {
    const std::string file = name + " " + std::to_string(making.size_px.width) + " stable.jpg";
    const cv::Mat image = cv::imread((call.folder / "flights" / file).string());
    if (image.empty()) accuracy::stop(file + ": not there; run flights first");
    cards.push_back(titled(image, name));
  }
  write_jpeg(call.folder / "flights.jpg", rows_of(cards, 6));
}

void draw_stages(OwnBodyMethod method, const flights::Flight& flight, int frames, const accuracy::Call& call) {
  const Clip clip = encoded_clip(flight, frames, call.folder);
  const Finding finding = found_in(clip, with_method(method, frames), KeepStages::yes);
  std::filesystem::remove(clip.path);
  const cv::Mat frame = flight.bgr(frames - 1);
  std::vector<cv::Mat> cards{titled(frame, "A frame")};
  for (const DetectionStage& stage : finding.body.stages) cards.push_back(titled(stage.image, stage.title));
  if (finding.cannot.empty()) cards.push_back(titled(overlay(frame, finding.body.mask, {}), "The mask over it"));
  write_jpeg(call.folder / (std::string("stages-") + name_of(method) + ".jpg"),
             rows_of(cards, std::min(4, static_cast<int>(cards.size()))));
}

// Masks of the real clips as they were found; the footage itself is not ours to show.
void draw_real_masks(const accuracy::Call& call) {
  std::vector<cv::Mat> cards;
  for (const char* name : {"sample clip", "bonnet", "coast", "road", "coast + nose", "coast + wing tips",
                           "coast + cockpit frame", "coast + belly and strut"}) {
    const auto path = call.folder / "real" / (std::string(name) + " stable mask.png");
    if (!std::filesystem::exists(path)) continue;
    const cv::Mat mask = cv::imread(path.string(), cv::IMREAD_GRAYSCALE);
    const cv::Mat plain(mask.size(), CV_8UC3, cv::Scalar(150, 140, 130));
    cards.push_back(titled(overlay(plain, mask, {}), name));
  }
  int height = 0;
  for (const cv::Mat& card : cards) height = std::max(height, card.rows);
  for (cv::Mat& card : cards) cv::copyMakeBorder(card, card, 0, height - card.rows, 0, 0, cv::BORDER_CONSTANT, kCard);
  if (!cards.empty()) write_image(call.folder / "real-masks.png", rows_of(cards, 4));
}

}  // namespace

void draw_images(const accuracy::Call& call) {
  const flights::FlightSettings making{.size_px = call.quick ? cv::Size(320, 240) : cv::Size(640, 480),
                                       .frames = call.quick ? 80 : 300};
  draw_flights(making, call);
  const flights::Flight flight = flights::by_name("nose", making);
  for (const OwnBodyMethod method : {OwnBodyMethod::paper, OwnBodyMethod::stable})
    draw_stages(method, flight, making.frames, call);
  draw_real_masks(call);
}

}  // namespace sigs::bench

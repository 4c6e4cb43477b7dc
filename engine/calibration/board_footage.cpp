// SPDX-License-Identifier: MIT
#include "calibration/board.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <opencv2/calib3d.hpp>
#include <optional>
#include <thread>
#include <utility>

#include "base/image_codecs.h"
#include "base/paths.h"
#include "base/text.h"
#include "base/threads.h"
#include "video/frame_source.h"

namespace sigs {

namespace {

namespace fs = std::filesystem;
constexpr int kBatch = 8;           // images searched side by side
constexpr int kLooksForOthers = 4;  // images in which another board is looked for

struct Candidate {
  std::string name;
  cv::Mat luma;
};

// Searches images in batches, and keeps what is found in their order.
class Searcher {
 public:
  Searcher(const CalibrationBoard& board, const BoardSearch& search) : board_(board), search_(search) {}

  [[nodiscard]] bool is_cancelled() const { return search_.cancel != nullptr && *search_.cancel; }

  // An image of another size than the first is left out.
  void add(Candidate candidate) {
    if (found_.size_px.empty()) found_.size_px = candidate.luma.size();
    if (candidate.luma.size() != found_.size_px) {
      if (others_++ == 0) other_ = fmt::format("{} is {}", candidate.name, image_size_text(candidate.luma.size()));
      return;
    }
    batch_.push_back(std::move(candidate));
    if (batch_.size() == kBatch) search_batch();
  }

  void tell(int done, int total) const {
    if (search_.progress) search_.progress(done, total);
  }

  BoardFootage finished() {
    search_batch();
    if (others_ > 0)
      found_.warnings.push_back(
          {other_, fmt::format("the first image is {}: {} of another size left out; calibrate each size by itself",
                               image_size_text(found_.size_px), count_text(others_, "image"))});
    return std::move(found_);
  }

 private:
  void search_batch() {
    std::vector<std::optional<BoardView>> views(batch_.size());
    const auto threads = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
    parallel_for(static_cast<int>(batch_.size()), threads, [&](int i) {
      const auto at = static_cast<std::size_t>(i);
      if (!is_cancelled()) views[at] = found_board(batch_[at].luma, board_);
    });
    for (std::size_t i = 0; i < views.size(); ++i) {
      ++found_.searched;
      if (views[i]) {
        views[i]->name = batch_[i].name;
        found_.views.push_back(std::move(*views[i]));
      } else if (found_.views.empty() && found_.seen_instead.empty() && looked_++ < kLooksForOthers) {
        found_.seen_instead = other_board_in(batch_[i].luma, board_);
      }
    }
    batch_.clear();
  }

  const CalibrationBoard& board_;
  const BoardSearch& search_;
  BoardFootage found_;
  std::vector<Candidate> batch_;
  int others_ = 0;  // images of another size
  std::string other_;
  int looked_ = 0;
};

Error stopped() {
  return {"", "interrupted", ErrorKind::interrupted};
}

Result<void> search_video(const fs::path& path, const BoardSearch& search, Searcher& searcher) {
  Result<FrameSource> footage = FrameSource::open(path, search.cancel);
  if (!footage) return fail(footage.error());
  const int count = footage->info().frame_count();
  const int group = (count + search.most_searched - 1) / std::max(1, search.most_searched);
  LumaStream stream(*footage, {.first = 0, .every = 1, .count = count});
  std::optional<LumaFrame> best;
  double best_detail = -1;
  while (std::optional<Result<LumaFrame>> next = stream.next()) {
    if (!*next) return fail(next->error());
    LumaFrame frame = std::move(**next);
    const int number = frame.number;
    const double detail = group > 1 ? detail_of(frame.luma) : 0;
    if (!frame.damaged && detail > best_detail) {
      best_detail = detail;
      best = std::move(frame);
    }
    if ((number + 1) % group == 0 || number + 1 == count) {
      if (best) searcher.add({fmt::format("frame {}", best->number), best->luma.clone()});
      best.reset();
      best_detail = -1;
    }
    searcher.tell(number + 1, count);
    if (searcher.is_cancelled()) return fail(stopped());
  }
  return {};
}

Result<void> search_images(const std::vector<fs::path>& paths, Searcher& searcher) {
  int done = 0;
  for (const fs::path& path : paths) {
    Result<cv::Mat> luma = read_image_file(path, cv::IMREAD_GRAYSCALE | cv::IMREAD_IGNORE_ORIENTATION);
    if (!luma) return fail(luma.error());
    searcher.add({path.filename().string(), std::move(*luma)});
    searcher.tell(++done, static_cast<int>(paths.size()));
    if (searcher.is_cancelled()) return fail(stopped());
  }
  return {};
}

Result<std::vector<fs::path>> images_in(const fs::path& folder) {
  Result<std::vector<fs::path>> paths = folder_contents(folder);
  if (!paths) return fail(paths.error());
  std::erase_if(*paths, [](const fs::path& path) { return !is_image_name(path); });
  if (paths->empty()) return fail(folder.string(), "no images in this folder", ErrorKind::cannot_read);
  return paths;
}

Result<BoardFootage> found_in(const std::vector<fs::path>& inputs, const CalibrationBoard& board,
                              const BoardSearch& search) {
  Searcher searcher(board, search);
  std::vector<fs::path> images;
  for (const fs::path& input : inputs) {
    if (is_image_name(input)) {
      images.push_back(input);
    } else if (is_folder(input)) {
      const Result<std::vector<fs::path>> more = images_in(input);
      if (!more) return fail(more.error());
      images.insert(images.end(), more->begin(), more->end());
    } else if (const Result<void> done = search_video(input, search, searcher); !done) {
      return fail(done.error());
    }
  }
  if (const Result<void> done = search_images(images, searcher); !done) return fail(done.error());
  BoardFootage found = searcher.finished();
  if (searcher.is_cancelled()) return fail(stopped());
  return found;
}

}  // namespace

bool is_image_name(const fs::path& path) {
  static constexpr std::array<std::string_view, 8> kExtensions{".png",  ".jpg", ".jpeg", ".tif",
                                                               ".tiff", ".bmp", ".webp", ".pgm"};
  return std::ranges::find(kExtensions, lower_extension(path)) != kExtensions.end();
}

Result<BoardFootage> board_footage(const std::vector<fs::path>& inputs, const CalibrationBoard& board,
                                   const BoardSearch& search) {
  return guarded([&] { return found_in(inputs, board, search); });
}

namespace {

constexpr double kWidestEdge = 1.8;    // of the first quartile
constexpr double kSharpEdge_px = 2.5;  // no wider one is left out
constexpr double kAlike = 0.01;        // of the image's diagonal

using OuterCorners = std::array<cv::Point2d, 4>;  // shares of the image's diagonal

OuterCorners outer_corners(const BoardView& view, const CalibrationBoard& board, cv::Size size_px) {
  std::vector<cv::Point2d> on_board;
  for (const int id : view.ids) on_board.push_back(board.corner_m(id) / board.square_m);
  const double right = board.corners.width - 1;
  const double bottom = board.corners.height - 1;
  std::vector<cv::Point2d> outer{{0, 0}, {right, 0}, {right, bottom}, {0, bottom}};
  const cv::Mat homography = cv::findHomography(on_board, view.at_px);
  if (!homography.empty()) cv::perspectiveTransform(outer, outer, homography);
  OuterCorners shares;
  const double diagonal_px = std::hypot(size_px.width, size_px.height);
  for (std::size_t i = 0; i < shares.size(); ++i) {
    // A corner that the homography takes far away says no more than that it is outside.
    const auto share = [&](double px) { return std::isfinite(px) ? std::clamp(px / diagonal_px, -0.5, 1.5) : 0.0; };
    shares[i] = {share(outer[i].x), share(outer[i].y)};
  }
  return shares;
}

// A chessboard looks the same upside down: the smaller difference counts.
double difference(const OuterCorners& a, const OuterCorners& b) {
  double same = 0;
  double turned = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    same += (a[i] - b[i]).ddot(a[i] - b[i]);
    turned += (a[i] - b[(i + 2) % 4]).ddot(a[i] - b[(i + 2) % 4]);
  }
  return std::sqrt(std::min(same, turned) / 4);
}

int drop_blurred(std::vector<BoardView>& views) {
  if (views.empty()) return 0;
  std::vector<double> edges_px;
  for (const BoardView& view : views) edges_px.push_back(view.edge_px);
  std::ranges::sort(edges_px);
  const double widest_px = std::max(kSharpEdge_px, kWidestEdge * edges_px[edges_px.size() / 4]);
  return static_cast<int>(std::erase_if(views, [&](const BoardView& view) { return view.edge_px > widest_px; }));
}

// Indices of the views taken, ascending.
std::vector<std::size_t> most_different(const std::vector<BoardView>& views, const std::vector<OuterCorners>& corners,
                                        int most) {
  std::vector<std::size_t> taken;
  std::vector<double> distances(views.size(), std::numeric_limits<double>::infinity());
  const auto sharper = [](const BoardView& a, const BoardView& b) { return a.edge_px < b.edge_px; };
  auto next = static_cast<std::size_t>(std::ranges::min_element(views, sharper) - views.begin());
  while (static_cast<int>(taken.size()) < most && distances[next] > kAlike) {
    taken.push_back(next);
    for (std::size_t i = 0; i < views.size(); ++i)
      distances[i] = std::min(distances[i], difference(corners[i], corners[next]));
    next = static_cast<std::size_t>(std::ranges::max_element(distances) - distances.begin());
  }
  std::ranges::sort(taken);
  return taken;
}

}  // namespace

ViewSelection selected_views(std::vector<BoardView> views, const CalibrationBoard& board, cv::Size size_px, int most) {
  ViewSelection selection;
  selection.blurred = drop_blurred(views);
  if (views.empty()) return selection;
  std::vector<OuterCorners> corners;
  for (const BoardView& view : views) corners.push_back(outer_corners(view, board, size_px));
  const std::vector<std::size_t> taken = most_different(views, corners, most);
  selection.alike = static_cast<int>(views.size() - taken.size());
  for (const std::size_t i : taken) selection.views.push_back(std::move(views[i]));
  return selection;
}

}  // namespace sigs

// SPDX-License-Identifier: MIT
#include "editor/preview/board.h"

#include <doctest/doctest.h>

#include <vector>

using namespace sigs;
using namespace sigs::editor;

namespace {

constexpr int kStates = 10'001;

// A window, and in place of the threads somebody who names each state that is wanted and makes its picture at once.
struct Table {
  Board board{PreviewLimits{.cache_bytes = 1 << 16}, [] {}};

  void want(const Revision& revision) { board.want({.revision = revision}); }

  // Whether the picture of what is wanted is shown.
  bool make_and_look(const Revision& revision) {
    const auto state = static_cast<std::uint64_t>(revision.project->camera.speed_mps) + 1;
    board.name_revision(revision.number, state, {.id = 1});
    const FrameKey key{state, 0};
    if (!board.has_picture(key)) {
      Picture picture{.revision = revision.number};
      picture.bgr = cv::Mat(8, 8, CV_8UC3, cv::Scalar::all(static_cast<double>(state % 251)));
      board.put_picture(key, std::make_shared<const Picture>(std::move(picture)), 1, true);
    }
    const Shown shown = board.shown();
    return shown.picture_is_current && shown.picture && shown.picture->bgr.at<cv::Vec3b>(0, 0)[0] == state % 251;
  }

  bool shows(const Revision& revision) {
    want(revision);
    return make_and_look(revision);
  }
};

ChangeProject speed(int mps, const std::string& gesture) {
  return {"set speed", [=](Project& project) { project.camera.speed_mps = mps; }, gesture};
}

}  // namespace

TEST_CASE("after a drag of ten thousand moves undo, redo and the next edit are shown") {
  Table table;
  Document document;
  CHECK(table.shows(document.revision()));
  int missed = 0;
  for (int i = 1; i < kStates; ++i) {
    document.apply(Edit(speed(i, "drag")));
    missed += table.shows(document.revision()) ? 0 : 1;
  }
  CHECK(missed == 0);
  document.apply(Edit(EndGesture{}));
  document.apply(Edit(Undo{}));
  CHECK(document.revision().number == document.first_number());
  CHECK(table.shows(document.revision()));
  document.apply(Edit(Redo{}));
  CHECK(table.shows(document.revision()));
  document.apply(Edit(Undo{}));
  document.apply(Edit(speed(kStates + 5, "")));
  CHECK(table.shows(document.revision()));
}

TEST_CASE("undo held down over ten thousand states shows each of them") {
  Table table;
  Document document;
  std::vector<Revision> revisions{document.revision()};
  for (int i = 1; i < kStates; ++i) {
    document.apply(Edit(speed(i, "")));
    revisions.push_back(document.revision());
    REQUIRE(table.shows(document.revision()));
  }
  int missed = 0;
  for (auto back = revisions.rbegin(); back != revisions.rend(); ++back) missed += table.shows(*back) ? 0 : 1;
  CHECK(missed == 0);
  CHECK(table.shows(revisions[1]));
}

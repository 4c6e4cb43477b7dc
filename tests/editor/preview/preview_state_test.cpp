// SPDX-License-Identifier: MIT
#include "editor/preview/preview_state.h"

#include <doctest/doctest.h>

#include <vector>

using namespace sigs;
using namespace sigs::editor;

namespace {

constexpr int kStates = 10'001;

// A window, and in place of the threads somebody who names each state that is wanted and makes its image at once.
struct PreviewStateFixture {
  PreviewState preview_state{PreviewLimits{.cache_bytes = 1 << 16}, [] {}};

  void want(const Revision& revision) { preview_state.want({.revision = revision}); }

  // Whether the image of what is wanted is shown.
  bool make_and_look(const Revision& revision) {
    const auto state = static_cast<std::uint64_t>(revision.project->camera.speed_mps) + 1;
    preview_state.identify_revision(revision.number, state, {.id = 1});
    const FrameKey key{state, 0};
    if (!preview_state.has_image(key)) {
      PreviewImage image{.revision = revision.number};
      image.bgr = cv::Mat(8, 8, CV_8UC3, cv::Scalar::all(static_cast<double>(state % 251)));
      preview_state.put_image(key, std::make_shared<const PreviewImage>(std::move(image)), 1, true);
    }
    const PreviewOutput shown = preview_state.shown();
    return shown.image_is_current && shown.image && shown.image->bgr.at<cv::Vec3b>(0, 0)[0] == state % 251;
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
  PreviewStateFixture fixture;
  Document document;
  CHECK(fixture.shows(document.revision()));
  int missed = 0;
  for (int i = 1; i < kStates; ++i) {
    document.apply(Edit(speed(i, "drag")));
    missed += fixture.shows(document.revision()) ? 0 : 1;
  }
  CHECK(missed == 0);
  document.apply(Edit(EndGesture{}));
  document.apply(Edit(Undo{}));
  CHECK(document.revision().number == document.first_number());
  CHECK(fixture.shows(document.revision()));
  document.apply(Edit(Redo{}));
  CHECK(fixture.shows(document.revision()));
  document.apply(Edit(Undo{}));
  document.apply(Edit(speed(kStates + 5, "")));
  CHECK(fixture.shows(document.revision()));
}

TEST_CASE("undo held down over ten thousand states shows each of them") {
  PreviewStateFixture fixture;
  Document document;
  std::vector<Revision> revisions{document.revision()};
  for (int i = 1; i < kStates; ++i) {
    document.apply(Edit(speed(i, "")));
    revisions.push_back(document.revision());
    REQUIRE(fixture.shows(document.revision()));
  }
  int missed = 0;
  for (auto back = revisions.rbegin(); back != revisions.rend(); ++back) missed += fixture.shows(*back) ? 0 : 1;
  CHECK(missed == 0);
  CHECK(fixture.shows(revisions[1]));
}

#include <doctest/doctest.h>
#include "ego_motion/features.h"
#include "video/luma_stream.h"
#include "support/test_data.h"
#include <map>
namespace sigs::test {
TEST_CASE("debugflow") {
  Result<FrameSource> footage = FrameSource::open(real_data() / "video/air_karma_gopro_coast.mp4");
  FeatureTracker t(footage->info().size_px, {}, {});
  std::map<int, cv::Point2f> last;
  for (int n = 0; n < 362; ++n) {
    auto f = footage->read(n);
    const auto& fs = t.next(luma_of(*f));
    std::vector<float> dx; int followed = 0;
    std::map<int, cv::Point2f> now;
    for (auto& x : fs) { now[x.id] = x.pixel_px; if (last.count(x.id)) { dx.push_back(x.pixel_px.x - last[x.id].x); ++followed; } }
    std::sort(dx.begin(), dx.end());
    if (n % 20 < 2) std::printf("%d n %zu followed %d dx q %.3f %.3f %.3f rep %d\n", n, fs.size(), followed, dx.empty() ? 0 : dx[dx.size() / 10], dx.empty() ? 0 : dx[dx.size() / 2], dx.empty() ? 0 : dx[dx.size() * 9 / 10], t.is_repeated());
    last = now;
    if (n == 10 || n == 200) std::printf("t=%.3f\n", f->time_s);
  }
}
}

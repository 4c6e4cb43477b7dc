// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <cstdlib>
#include <set>
#include <string>
#include <vector>

#include "export/export_project.h"
#include "frame/synthetic_scenes.h"
#include "scene/opened_project.h"
#include "support/files.h"
#include "video/frame.h"

namespace sigs::test {
namespace {

namespace fs = std::filesystem;

constexpr int kDeepFrames = 4;
const cv::Size kDeepSize(160, 120);

bool ffmpeg(const std::string& arguments) {
  if (std::system(("ffmpeg -nostdin -hide_banner -loglevel quiet -y " + arguments).c_str()) == 0) return true;
  say_skipped("the ffmpeg program is missing or cannot do: " + arguments);
  return false;
}

// Samples that the ffmpeg program decodes, plane after plane, image after image.
std::vector<int> decoded(const fs::path& video, const std::string& format, const fs::path& raw) {
  REQUIRE(
      ffmpeg("-i \"" + video.string() + "\" -f rawvideo -vsync 0 -pix_fmt " + format + " \"" + raw.string() + "\""));
  const std::string bytes = text_of(raw);
  std::vector<int> samples;
  const bool is_deep = format.ends_with("le");
  for (std::size_t i = 0; i + (is_deep ? 1 : 0) < bytes.size(); i += is_deep ? 2 : 1) {
    const int low = static_cast<unsigned char>(bytes[i]);
    samples.push_back(is_deep ? low | static_cast<unsigned char>(bytes[i + 1]) << 8 : low);
  }
  return samples;
}

struct DeepClip {
  std::string pixel_format;
  int bit_depth;
  cv::Size chroma;  // of a chroma plane; empty: gray
};

bool make_deep_clip(const Scenario& scenario, const DeepClip& clip) {
  return ffmpeg(
      "-f lavfi -i \"testsrc2=size=160x120:rate=25,format=yuv444p16le,gblur=sigma=6\" -frames:v 4 -c:v ffv1 "
      "-level 3 -color_range tv -colorspace bt709 -pix_fmt " +
      clip.pixel_format + " \"" + scenario.path("deep.mkv").string() + "\"");
}

void prepare_deep(Scenario& scenario) {
  write_calibration(scenario.path("lens.xml"), {160, 0, 81, 0, 161, 58, 0, 0, 1}, {-0.15, 0.03, 0.001, 0, 0},
                    kDeepSize);
  write_obj(scenario.path("aircraft.obj"), aircraft(), 1);
  scenario.project.footage.video = "deep.mkv";
  scenario.project.footage.calibration = "lens.xml";
  scenario.project.compositing.blur_px_per_m = 0.02;
  scenario.add("aircraft.obj", {40, 0, -150});
}

// Whether no pixel of a chroma sample (4:2:0, 4:2:2 at the left, or 4:4:4) is in the mask.
bool is_clear(const std::vector<int>& mask, std::size_t first, int x, int y, cv::Size step) {
  for (int j = y * step.height; j < std::min((y + 1) * step.height, kDeepSize.height); ++j)
    for (int i = std::max(x * step.width - (step.width - 1), 0); i < std::min((x + 1) * step.width, kDeepSize.width);
         ++i)
      if (mask[first + static_cast<std::size_t>(j * kDeepSize.width + i)] != 0) return false;
  return true;
}

}  // namespace

TEST_CASE("footage of 10 and 12 bits keeps the bits that ffmpeg decodes wherever no intruder is") {
  for (const DeepClip& clip :
       {DeepClip{"yuv420p10le", 10, {80, 60}}, DeepClip{"yuv422p10le", 10, {80, 120}},
        DeepClip{"yuv444p12le", 12, {160, 120}}, DeepClip{"gray10le", 10, {}}, DeepClip{"gray12le", 12, {}}}) {
    CAPTURE(clip.pixel_format);
    Scenario scenario(kDeepSize, kDeepFrames);
    prepare_deep(scenario);
    if (!make_deep_clip(scenario, clip)) return;
    const Result<ExportReport> report =
        export_project({.project = scenario.project, .folder = scenario.path("out"), .jobs = 2}, {});
    if (!report) FAIL(report.error().text());
    CHECK(report->warnings.empty());
    const std::vector<int> before = decoded(scenario.path("deep.mkv"), clip.pixel_format, scenario.path("a.raw"));
    const std::vector<int> after = decoded(scenario.path("out/lot.mkv"), clip.pixel_format, scenario.path("b.raw"));
    const std::vector<int> masks = decoded(scenario.path("out/lot.masks.mkv"), "gray", scenario.path("c.raw"));
    const std::size_t pixels = static_cast<std::size_t>(kDeepSize.area());
    const std::size_t frame_samples = pixels + 2 * static_cast<std::size_t>(clip.chroma.area());
    REQUIRE(before.size() == kDeepFrames * frame_samples);
    REQUIRE(after.size() == before.size());
    REQUIRE(masks.size() == kDeepFrames * pixels);
    int changed_outside = 0;
    int changed_inside = 0;
    std::set<int> lower_bits;  // of luma under the intruder: all occur where the blend has the footage's depth
    for (std::size_t frame = 0; frame < kDeepFrames; ++frame) {
      std::size_t at = frame * frame_samples;
      for (int plane = 0; plane < (clip.chroma.empty() ? 1 : 3); ++plane) {
        const cv::Size size = plane == 0 ? kDeepSize : clip.chroma;
        const cv::Size step(kDeepSize.width / size.width, kDeepSize.height / size.height);
        for (int y = 0; y < size.height; ++y)
          for (int x = 0; x < size.width; ++x, ++at) {
            const bool clear = is_clear(masks, frame * pixels, x, y, step);
            const bool same = before[at] == after[at];
            changed_outside += clear && !same ? 1 : 0;
            changed_inside += !clear && !same ? 1 : 0;
            if (plane == 0 && !clear) lower_bits.insert(after[at] % (1 << (clip.bit_depth - 8)));
          }
      }
    }
    CHECK(changed_outside == 0);
    CHECK(changed_inside > 500);
    CHECK(lower_bits.size() == std::size_t{1} << (clip.bit_depth - 8));
  }
}

TEST_CASE("the composite of deep footage is that of its 8-bit copy, to the step of 8 bits") {
  Scenario scenario(kDeepSize, kDeepFrames);
  write_footage(scenario.path("deep.mkv"), kDeepSize, kDeepFrames, PixelLayout::yuv420);
  prepare_deep(scenario);
  const Scene scene = scenario.opened();
  const Frame eight = grainy_frame(kDeepSize, 1);
  const Frame deep = with_bit_depth(eight, 12);
  const ComposedFrame a = composed(scene, 1, eight);
  const ComposedFrame b = composed(scene, 1, deep);
  CHECK(b.image.bit_depth == 12);
  CHECK(same_bytes(a.mask, b.mask));
  const Frame rounded = with_bit_depth(b.image, 8);
  for (std::size_t plane = 0; plane < 3; ++plane)
    CHECK(cv::norm(rounded.planes[plane], a.image.planes[plane], cv::NORM_INF) <= 1);
}

TEST_CASE("what cannot keep the footage's depth is named in a warning") {
  Scenario scenario;
  const VideoInfo ten{.bit_depth = 10};
  const auto warned = [&](const VideoInfo& video, const std::string& field, const std::string& what) {
    for (const Warning& warning : codec_warnings_of(scenario.project, video))
      if (warning.where.ends_with(field) && warning.what.find(what) != std::string::npos) return true;
    return false;
  };
  CHECK(codec_warnings_of(scenario.project, ten).empty());
  scenario.project.output.codec = VideoCodec::mjpeg;
  CHECK(warned(ten, "export.video.codec", "ffv1, h264, hevc, av1, png"));
  scenario.project.output.codec = VideoCodec::h264;
  CHECK(codec_warnings_of(scenario.project, ten).empty());
  CHECK(warned({.bit_depth = 12}, "export.video.codec", "ffv1, hevc, av1, png"));
  scenario.project.output.max_bit_depth = 8;
  CHECK(codec_warnings_of(scenario.project, {.bit_depth = 12}).empty());
  scenario.project.compositing.method = MethodChoice::classic;
  CHECK(warned(ten, "compositing.method", "classic works with 8 bits"));
  scenario.project.compositing.method = MethodChoice::direct;
  scenario.project.appearance.codec.match = CodecMatchChoice::h264;
  CHECK(warned(ten, "appearance.codec.match", "left out"));
}

}  // namespace sigs::test

// SPDX-License-Identifier: MIT

#include <doctest/doctest.h>

#include <numbers>

#include "support/test_data.h"
#include "telemetry/dji_cues.h"
#include "telemetry/gpmf.h"
#include "telemetry/gpmf_writer.h"

using namespace sigs;
using namespace sigs::test;

namespace {

std::string mp4_box(const std::string& type, const std::string& inside) {
  return big_endian_bytes(8 + inside.size(), 4) + type + inside;
}

std::string header_mp4(const std::string& elements) {
  const std::string gpmf = gpmf_nest("DEVC", gpmf_string("DVNM", "Global Settings") + elements);
  return mp4_box("ftyp", "mp41") + mp4_box("mdat", std::string(1000, 'x')) +
         mp4_box("moov", mp4_box("mvhd", std::string(100, '\0')) + mp4_box("udta", mp4_box("GPMF", gpmf)));
}

const std::string kElements = gpmf_string("VFOV", "L") + gpmf_floats("ZFOV", 1, {101.5F}) + gpmf_string("EISE", "Y") +
                              gpmf_string("EISA", "HS Boost");

}  // namespace

TEST_CASE("field of view and stabilisation are read from the header that a GoPro writes") {
  const TemporaryFolder folder;
  write_file(folder / "a.mp4", header_mp4(kElements));
  const std::optional<GoproHeader> header = read_gopro_header(folder / "a.mp4");
  REQUIRE(header);
  CHECK(header->is_stabilised);
  CHECK(header->stabilisation == "HS Boost");
  REQUIRE(header->lens());
  CHECK(*header->lens()->diagonal_fov_rad == doctest::Approx(101.5 * std::numbers::pi / 180));
  CHECK_FALSE(header->lens()->is_fisheye);
}

TEST_CASE("a GoPro header that is cut off or damaged anywhere is harmless") {
  const TemporaryFolder folder;
  const std::string whole = header_mp4(kElements);
  for (std::size_t length = 0; length < whole.size(); length += length < 1000 ? 97 : 1) {
    write_file(folder / "a.mp4", whole.substr(0, length));
    (void)read_gopro_header(folder / "a.mp4");
  }
  for (std::size_t at = 1012; at < whole.size(); ++at)
    for (const char byte : {'\0', '\xff'}) {
      std::string broken = whole;
      broken[at] = byte;
      write_file(folder / "a.mp4", broken);
      (void)read_gopro_header(folder / "a.mp4");
    }
  CHECK_FALSE(read_gopro_header(folder / "none.mp4"));
  CHECK_FALSE(read_gopro_header(folder.path()));
}

TEST_CASE("the focal length in DJI's subtitles is that of a sensor 36 mm wide, whatever the dialect's scale") {
  CHECK(*dji_values("[fnum : 280] [focal_len : 240]").focal_length_35mm_mm == doctest::Approx(24));
  CHECK(*dji_values("[fnum: 1.7] [focal_len: 24.00]").focal_length_35mm_mm == doctest::Approx(24));
  CHECK(*dji_values("[fnum: 1.9] [focal_len: 28.00] [dzoom_ratio: 2.00]").focal_length_35mm_mm == doctest::Approx(56));
  CHECK(*dji_values("[fnum : 280] [focal_len : 240] [dzoom_ratio: 10000, delta:0]").focal_length_35mm_mm ==
        doctest::Approx(24));
  CHECK_FALSE(dji_values("[iso : 100]").focal_length_35mm_mm);
}

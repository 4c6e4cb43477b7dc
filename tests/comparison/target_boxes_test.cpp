// SPDX-License-Identifier: MIT
#include "comparison/inserted_target.h"

#include <doctest/doctest.h>

#include "support/test_data.h"

using namespace sigs;
using namespace sigs::test;

TEST_CASE("the pixel (1, 1) of a file is the first one, and frames without a line have no box") {
  const TemporaryFolder folder;
  const auto file = folder / "boxes.csv";
  write_file(file,
             "frame,label,x,y,w,h\r\n0,AIRPLANE,1,1,1,1\n\n2,AIRPLANE,313.45,204.42,36.07,24.12\n3,AIRPLANE,5,5,0,0\n2,"
             "BIRD,1,1,9,9\n");
  const auto boxes = read_target_boxes(file);
  REQUIRE(boxes);
  REQUIRE(boxes->size() == 3);
  // The first pixel covers [-0.5, 0.5).
  CHECK((*boxes)[0] == Box{-0.5, -0.5, 1, 1});
  CHECK_FALSE((*boxes)[1].has_value());
  CHECK((*boxes)[2]->x == doctest::Approx(311.95));
  CHECK((*boxes)[2]->width == 36.07);
}

TEST_CASE("a file of boxes that cannot be understood is refused with its line") {
  const TemporaryFolder folder;
  const auto file = folder / "boxes.csv";
  for (const char* line :
       {"0,A,1,2,3", "0,A,x,2,3,4", "0.5,A,1,2,3,4", "-1,A,1,2,3,4", "0,A,1,2,3,inf", "99999999999,A,1,2,3,4"}) {
    write_file(file, std::string("frame,label,x,y,w,h\n0,A,1,2,3,4\n") + line + "\n");
    const auto boxes = read_target_boxes(file);
    REQUIRE_FALSE(boxes);
    CHECK(boxes.error().kind == ErrorKind::bad_data);
    CHECK_MESSAGE(boxes.error().text().find("line 3") != std::string::npos, boxes.error().text());
  }
  write_file(file, "frame,label,x,y,w,h\n");
  CHECK(read_target_boxes(file).error().kind == ErrorKind::bad_data);
  CHECK(read_target_boxes(folder / "none.csv").error().kind == ErrorKind::cannot_read);
}

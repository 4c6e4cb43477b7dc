// SPDX-License-Identifier: MIT
#include "dataset/entry.h"

#include <doctest/doctest.h>

#include <functional>
#include <vector>

#include "cli/tiny_project.h"
#include "project/json.h"
#include "support/test_data.h"

using namespace sigs;
using namespace sigs::test;

namespace {

std::string fingerprint(const TinyProject& tiny, const std::string& program = "test 1") {
  InputChecksums inputs;
  return fingerprint_of(read_project(tiny.project()).value().project, program, inputs).value();
}

}  // namespace

TEST_CASE("the same project and inputs at another place have the same fingerprint") {
  const TinyProject here;
  const TinyProject there;
  CHECK(here.project() != there.project());
  CHECK(fingerprint(here) == fingerprint(there));
}

TEST_CASE("whatever an export depends on changes the fingerprint") {
  const std::vector<std::function<void(TinyProject&)>> changes{
      [](TinyProject& tiny) { tiny.change("[20, 3, -150]", "[20, 3.001, -150]"); },
      [](TinyProject& tiny) { tiny.change("\"name\": \"tiny\"", "\"name\": \"small\""); },
      [](TinyProject& tiny) { write_file(tiny.file("cube.mtl"), "newmtl paint\nKd 0.8 0.2 0.3\n"); },
      [](TinyProject& tiny) { write_file(tiny.file("cube.obj"), "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"); },
      [](TinyProject& tiny) { write_file(tiny.file("lens.xml"), "another"); },
      [](TinyProject& tiny) { write_file(tiny.file("clip.mkv"), "another"); },
      [](TinyProject& tiny) {
        std::filesystem::rename(tiny.file("clip.mkv"), tiny.file("film.mkv"));
        tiny.change("clip.mkv", "film.mkv");
      },
      [](TinyProject& tiny) { std::filesystem::remove(tiny.file("cube.mtl")); }};
  for (std::size_t i = 0; i < changes.size(); ++i) {
    CAPTURE(i);
    TinyProject tiny;
    const std::string before = fingerprint(tiny);
    changes[i](tiny);
    CHECK(fingerprint(tiny) != before);
  }
  const TinyProject tiny;
  CHECK(fingerprint(tiny, "test 2") != fingerprint(tiny));
}

TEST_CASE("a calibration counts that is named with a camera of it") {
  TinyProject tiny;
  const std::string first = fingerprint(tiny);
  tiny.change("lens.xml", "lens.xml#left");
  const std::string left = fingerprint(tiny);
  CHECK(left != first);
  write_file(tiny.file("lens.xml"), "another");
  const std::string changed = fingerprint(tiny);
  CHECK(changed != left);
  tiny.change("lens.xml#left", "lens.xml#right");
  CHECK(fingerprint(tiny) != changed);
}

TEST_CASE("images of a model's materials count, however their names are written") {
  for (const char* const line : {"map_Kd skin of it.png", "map_Kd -s 2 2 1 SKIN OF IT.PNG",
                                 "map_Kd C:\\art\\skin of it.png", "map_d skin.png", "bump -bm 1 skin.png"}) {
    CAPTURE(line);
    const TinyProject tiny;
    write_file(tiny.file("cube.mtl"), std::string("newmtl paint\n") + line + "\n");
    const char* const name =
        std::string(line).find("of") == std::string::npos && std::string(line).find("OF") == std::string::npos
            ? "skin.png"
            : "skin of it.png";
    write_file(tiny.file(name), "one");
    const std::string before = fingerprint(tiny);
    write_file(tiny.file(name), "two");
    CHECK(fingerprint(tiny) != before);
  }
}

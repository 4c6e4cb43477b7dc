// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include "cli/program.h"
#include "support/files.h"
#include "support/test_data.h"

using namespace sigs;
using namespace sigs::test;

TEST_CASE("a model is imported once, beside its images, and what it is stands on stderr") {
  const TemporaryFolder folder;
  const std::string source = (source_dir() / "assets/models/light-aircraft/light-aircraft.obj").string();
  const std::string out = (folder / "mine/plane.obj").string();
  const Run run = run_sigs("model import " + source + " --keep-rotors --length 8.27 --out " + out);
  REQUIRE_MESSAGE(run.status == 0, run.err);
  CHECK(run.out.starts_with(out + "\n"));
  CHECK(run.out.find("fuselage.png") != std::string::npos);
  CHECK(run.err.find("axes: nose along +x of the file, top along +z, by its shape") != std::string::npos);
  CHECK(run.err.find("8.27 m long") != std::string::npos);
  CHECK(run_sigs("info " + out).status == 0);
  const std::string before = text_of(out);
  CHECK(run_sigs("model import " + source + " --out " + out).status == 73);
  CHECK(text_of(out) == before);
  CHECK(run_sigs("model import " + source + " --force --out " + out).status == 0);
}

TEST_CASE("info names a model's parts, by which a project makes them turn") {
  const TemporaryFolder folder;
  const std::string model = (folder / "plane.obj").string();
  write_file(model, "o plane\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\ng prop fast\nv 2 0 0\nv 2 1 0\nv 2 0 1\nf 4 5 6\n");
  const Run run = run_sigs("info " + model);
  CHECK(run.status == 0);
  CHECK(run.out.find("\ngroup or object prop\ngroup or object plane\n") != std::string::npos);
}

TEST_CASE("an import that cannot be says why, with the status of its kind, and leaves nothing") {
  const TemporaryFolder folder;
  const std::string source = (source_dir() / "assets/models/bird/bird.obj").string();
  const std::string out = (folder / "new/bird.obj").string();
  CHECK(run_sigs("model import " + (folder / "none.glb").string()).status == 66);
  CHECK(run_sigs("model import " + source + " --forward sideways --out " + out).status == 64);
  CHECK(run_sigs("model import " + source + " --out " + (folder / "bird.stl").string()).status == 64);
  CHECK(run_sigs("model import " + source + " --length 0").status == 64);
  write_file(folder / "text.fbx", "hello");
  const Run run = run_sigs("model import " + (folder / "text.fbx").string() + " --out " + out);
  CHECK(run.status == 65);
  CHECK(run.err.find("text.fbx: is no model that can be read") != std::string::npos);
  CHECK_FALSE(std::filesystem::exists(folder / "new"));
}

TEST_CASE("the list of models has those of the program, with what they are") {
  const Run run = run_sigs("model list");
  CHECK(run.status == 0);
  for (const char* const line : {"  airliner                     airplane", "  helicopter-medium            helicopter",
                                 "  multirotor-hexa              drone", "  bird-dark                    bird"})
    CHECK_MESSAGE(run.out.find(line) != std::string::npos, line);
}

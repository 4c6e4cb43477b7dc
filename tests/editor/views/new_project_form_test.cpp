// SPDX-License-Identifier: MIT
#include "editor/views/new_project/new_project_form.h"

#include <doctest/doctest.h>

#include <filesystem>
#include <string>

#include "support/test_data.h"

using namespace sigs;
using namespace sigs::editor;
using sigs::test::source_dir;
using sigs::test::TemporaryFolder;
using sigs::test::write_file;

namespace {

namespace fs = std::filesystem;

struct FormFixture {
  TemporaryFolder folder;
  NewProjectForm form;

  FormFixture() {
    write_file(folder / "flight.mp4", std::string("\0\0\0\x18"
                                                  "ftypmp42",
                                                  12));
    set_video(form, (folder / "flight.mp4").string(), "/nowhere");
  }
  // The row with the first problem; none: it can be used.
  [[nodiscard]] std::optional<FormRow> wrong_row() const {
    const std::optional<FormProblem> problem = problem_of(form);
    return problem ? std::optional(problem->row) : std::nullopt;
  }
};

}  // namespace

TEST_CASE("a video alone is enough: its lens is guessed, and the project lies beside it under its name") {
  const FormFixture d;
  CHECK_FALSE(d.wrong_row());
  const FirstProjectOptions options = options_of(d.form, sample_models_in(source_dir() / "assets/models"));
  CHECK(options.video == d.folder / "flight.mp4");
  CHECK(options.out == d.folder / "flight.json");
  CHECK(options.calibration.empty());
  CHECK_FALSE(options.horizontal_fov_deg);
  CHECK(options.model.empty());  // the sample light aircraft
  CHECK_FALSE(options.overwrite);
  CHECK_FALSE(options.plain);
}

TEST_CASE("the project proposed for a video is never one that is there, and lies where it can be written") {
  const FormFixture d;
  write_file(d.folder / "flight.json", "{}");
  CHECK(usual_project_file(d.folder / "flight.mp4", "/nowhere") == d.folder / "flight-2.json");
  write_file(d.folder / "flight-2.json", "{}");
  CHECK(usual_project_file(d.folder / "flight.mp4", "/nowhere") == d.folder / "flight-3.json");
  CHECK(usual_project_file("/nowhere/flight.mp4", d.folder.path()) == d.folder / "flight-3.json");
}

TEST_CASE("a name that was chosen for the project stays when the video is another one") {
  FormFixture d;
  write_file(d.folder / "other.mp4", "x");
  set_video(d.form, (d.folder / "other.mp4").string(), "/nowhere");
  CHECK(d.form.file == (d.folder / "other.json").string());
  d.form.file = (d.folder / "mine.json").string();
  d.form.is_file_chosen = true;
  set_video(d.form, (d.folder / "flight.mp4").string(), "/nowhere");
  CHECK(d.form.file == (d.folder / "mine.json").string());
}

TEST_CASE("each mistake is named in its own row") {
  FormFixture d;
  set_video(d.form, "", "/nowhere");
  CHECK(d.wrong_row() == FormRow::video);
  set_video(d.form, d.folder.path().string(), "/nowhere");
  CHECK(d.wrong_row() == FormRow::video);
  set_video(d.form, (d.folder / "gone.mp4").string(), "/nowhere");
  CHECK(d.wrong_row() == FormRow::video);
  set_video(d.form, (d.folder / "flight.mp4").string(), "/nowhere");

  d.form.lens = LensChoice::field_of_view;
  for (const char* const text : {"", "wide", "0", "-70", "360", "7o", "nan", "inf", "70 mm"}) {
    CAPTURE(text);
    d.form.fov_deg = text;
    CHECK(d.wrong_row() == FormRow::lens);
  }
  d.form.lens = LensChoice::calibration;
  CHECK(d.wrong_row() == FormRow::lens);
  d.form.calibration = "/nowhere/gopro.xml";
  CHECK(d.wrong_row() == FormRow::lens);
  d.form.lens = LensChoice::guess;  // what is typed in the other rows does not count

  d.form.sample.reset();
  CHECK(d.wrong_row() == FormRow::model);
  d.form.model = (d.folder / "flight.mp4").string();
  CHECK_FALSE(d.wrong_row());  // whether it is a model is found when it is read

  for (const fs::path& file : {fs::path(), d.folder / "flight", d.folder / "flight.mp4", d.folder / "no/a.json",
                               d.folder / ".json", d.folder / "a\nb.json"}) {
    CAPTURE(file);
    d.form.file = file.string();
    CHECK(d.wrong_row() == FormRow::file);
  }
}

TEST_CASE("the lens and the aircraft that were chosen are those that are asked for, and no others") {
  FormFixture d;
  const std::vector<SampleModel> samples = sample_models_in(source_dir() / "assets/models");
  REQUIRE(samples.size() >= 3);
  CHECK(samples[0].name == "Light aircraft");
  CHECK(sample_models_in("/nowhere").empty());
  d.form.fov_deg = " 69,5 ";
  d.form.calibration = "lens.xml";
  CHECK_FALSE(options_of(d.form, samples).horizontal_fov_deg);
  CHECK(options_of(d.form, samples).calibration.empty());
  d.form.lens = LensChoice::field_of_view;
  CHECK_FALSE(d.wrong_row());
  CHECK(options_of(d.form, samples).horizontal_fov_deg == 69.5);
  CHECK(options_of(d.form, samples).calibration.empty());
  d.form.lens = LensChoice::calibration;
  CHECK_FALSE(options_of(d.form, samples).horizontal_fov_deg);
  CHECK(options_of(d.form, samples).calibration == fs::current_path() / "lens.xml");
  d.form.model = "/models/jet.obj";
  d.form.sample = 1;
  CHECK(options_of(d.form, samples).model == samples[1].file);
  CHECK(fs::is_regular_file(samples[1].file));
  d.form.sample.reset();
  CHECK(options_of(d.form, samples).model == "/models/jet.obj");
  d.form.matches_footage = false;
  CHECK(options_of(d.form, samples).plain);
}

TEST_CASE("a file dropped onto the dialog goes into the row of its kind; others say why they do not") {
  FormFixture d;
  write_file(d.folder / "b.mp4", std::string("\0\0\0\x18"
                                             "ftypmp42",
                                             12));
  write_file(d.folder / "lens.yaml", "%YAML:1.0\n---\n");
  write_file(d.folder / "jet.obj", "v 0 0 0\n");
  write_file(d.folder / "letter.doc", "Dear Sir");
  write_file(d.folder / "mask.png", "\x89PNG");
  CHECK(take_dropped(d.form, d.folder / "b.mp4", "/nowhere").empty());
  CHECK(d.form.video == (d.folder / "b.mp4").string());
  CHECK(d.form.file == (d.folder / "b.json").string());
  CHECK(take_dropped(d.form, d.folder / "lens.yaml", "/nowhere").empty());
  CHECK(d.form.lens == LensChoice::calibration);
  CHECK(d.form.calibration == (d.folder / "lens.yaml").string());
  CHECK(take_dropped(d.form, d.folder / "jet.obj", "/nowhere").empty());
  CHECK_FALSE(d.form.sample);
  CHECK(d.form.model == (d.folder / "jet.obj").string());
  for (const char* const other : {"letter.doc", "mask.png", "gone.mp4"}) {
    const std::string message = take_dropped(d.form, d.folder / other, "/nowhere");
    CHECK(message.find(other) != std::string::npos);
  }
  CHECK(d.form.video == (d.folder / "b.mp4").string());
}

TEST_CASE("paths are typed as in a shell: from the home folder, from the current one, with blanks around") {
  CHECK(typed_path("").empty());
  CHECK(typed_path("  ").empty());
  CHECK(typed_path(" /a/../b.mp4 ") == "/b.mp4");
  CHECK(typed_path("c.mp4") == fs::current_path() / "c.mp4");
  if (const char* const home = std::getenv("HOME")) CHECK(typed_path("~/c.mp4") == fs::path(home) / "c.mp4");
}

// SPDX-License-Identifier: MIT
// No run touches a file that it did not create, except those that it is asked to replace.
#include <doctest/doctest.h>
#include <sys/stat.h>

#include <filesystem>
#include <map>
#include <opencv2/imgcodecs.hpp>
#include <string>
#include <vector>

#include "base/staged_outputs.h"
#include "cli/program.h"
#include "cli/tiny_project.h"
#include "cli/tiny_recipe.h"
#include "labels/labels.h"
#include "occlusion/synthetic_clip.h"
#include "support/files.h"
#include "support/test_data.h"

namespace sigs::test {
namespace {

namespace fs = std::filesystem;

constexpr const char* kPatience = "timeout 120";  // a FIFO that is opened would block for ever

// An image of the footage's size, for masks and textures; black occludes nothing.
void write_image(const fs::path& file, cv::Size size_px = {64, 48}) {
  fs::create_directories(file.parent_path());
  REQUIRE(cv::imwrite(file.string(), cv::Mat::zeros(size_px, CV_8UC1)));
}

// An earlier export's folder of images has the output's name and contains an input.
struct ExistingImages {
  TinyProject tiny;
  std::string options = "--codec png --masks none --labels none --out " + tiny.out();

  ExistingImages() { REQUIRE(run_sigs("export " + tiny.project() + " " + options).status == 0); }
  [[nodiscard]] std::string image(const std::string& name) const { return tiny.out() + "/tiny/" + name; }

  void check_refused(const std::string& named, const std::string& more = "") const {
    const std::map<std::string, std::string> before = contents_of(tiny.out());
    const Run run = run_sigs("export " + tiny.project() + " " + options + " --force " + more);
    CHECK_MESSAGE(run.status == 73, run.err);
    CHECK_MESSAGE(has(run.err, named), run.err);
    CHECK_MESSAGE(has(run.err, "is read by this export"), run.err);
    CHECK_MESSAGE(run.err.find("error: ", run.err.find("error: ") + 1) == std::string::npos, run.err);
    CHECK(contents_of(tiny.out()) == before);
  }
};

}  // namespace

TEST_CASE("footage named like a temporary file is preserved") {
  const TinyProject tiny;
  fs::rename(tiny.file("clip.mkv"), tiny.file("clip.part.mkv"));
  const std::string footage = text_of(tiny.file("clip.part.mkv"));
  const Run run = run_sigs("export " + tiny.project() + " --set name=clip --set footage.video=clip.part.mkv --out " +
                           tiny.file("").string());
  CHECK_MESSAGE(run.status == 0, run.err);
  REQUIRE(fs::exists(tiny.file("clip.part.mkv")));
  CHECK(text_of(tiny.file("clip.part.mkv")) == footage);
  CHECK(fs::exists(tiny.file("clip.masks.mkv")));
}

TEST_CASE("files, folders, links and FIFOs of any names beside the outputs are preserved") {
  const TinyProject tiny;
  const fs::path out = tiny.out();
  fs::create_directories(out / "tiny.part");
  fs::create_directories(tiny.file("elsewhere"));
  write_file(out / "tiny.part/mine.txt", "mine");
  write_file(out / "tiny.part.xml", "mine");
  write_file(out / "frame_3.part.png", "mine");
  write_file(tiny.file("target"), "mine");
  write_file(tiny.file("elsewhere/mine.txt"), "mine");
  fs::create_symlink(tiny.file("target"), out / "tiny.coco.part.json");
  fs::create_directory_symlink(tiny.file("elsewhere"), out / "tiny.masks.part");
  REQUIRE(mkfifo((out / "tiny.part.csv").c_str(), 0600) == 0);
  const Run run = run_sigs_after(kPatience, "export " + tiny.project() + " --out " + out.string() +
                                                " --codec png --masks png --labels xml,coco,csv");
  CHECK_MESSAGE(run.status == 0, run.err);
  const Run frame = run_sigs("frame " + tiny.project() + " --frame 3 --out " + out.string());
  CHECK_MESSAGE(frame.status == 0, frame.err);
  for (const fs::path& file : {out / "tiny.part/mine.txt", out / "tiny.part.xml", out / "frame_3.part.png",
                               tiny.file("target"), tiny.file("elsewhere/mine.txt")}) {
    REQUIRE_MESSAGE(fs::exists(file), file);
    CHECK_MESSAGE(text_of(file) == "mine", file);
  }
  CHECK(fs::is_symlink(out / "tiny.coco.part.json"));
  CHECK(fs::is_symlink(out / "tiny.masks.part"));
  CHECK(fs::is_fifo(out / "tiny.part.csv"));
  for (const char* const made : {"tiny", "tiny.masks", "tiny.xml", "tiny.coco.json", "tiny.csv", "frame_3.png"})
    CHECK_MESSAGE(fs::exists(out / made), made);
}

TEST_CASE("a frame goes into the folder or the PNG that is named, with its stages beside it") {
  const TinyProject tiny;
  const fs::path out = tiny.out();
  const std::string call = "frame " + tiny.project() + " --frame 3 --stages --out ";
  const auto files_in = [](const fs::path& folder) {
    std::map<std::string, std::string> texts;
    for (const auto& entry : fs::directory_iterator(folder)) texts[entry.path().filename()] = text_of(entry.path());
    return texts;
  };
  REQUIRE(run_sigs(call + out.string()).status == 0);
  const auto in_folder = files_in(out);
  REQUIRE(in_folder.size() > 3);
  const Run named = run_sigs(call + (out / "named/shown.png").string());
  REQUIRE_MESSAGE(named.status == 0, named.err);
  const auto beside = files_in(out / "named");
  CHECK(beside.size() == in_folder.size());
  for (const auto& file : in_folder) {
    CAPTURE(file.first);
    const std::string other = "shown" + file.first.substr(std::string("frame_3").size());
    REQUIRE(beside.contains(other));
    CHECK(beside.at(other) == file.second);
  }
  CHECK(run_sigs(call + (out / "named/shown.png").string()).status == 73);
  fs::create_directory(out / "folder.png");
  CHECK(run_sigs(call + (out / "folder.png").string()).status == 0);
  CHECK(fs::exists(out / "folder.png/frame_3.png"));
}

TEST_CASE("a mask's footage may be named like the mask's temporary file") {
  const TemporaryFolder folder;
  write_flight(folder / "vv.mkv", 10);
  fs::rename(folder / "vv.mkv", folder / "vv.part.png");
  const std::string footage = text_of(folder / "vv.part.png");
  const Run run =
      run_sigs("mask " + (folder / "vv.part.png").string() + " --method paper --out " + (folder / "vv.png").string());
  CHECK_MESSAGE(run.status == 0, run.err);
  REQUIRE(fs::exists(folder / "vv.part.png"));
  CHECK(text_of(folder / "vv.part.png") == footage);
}

TEST_CASE("a dataset preserves a .part file of another program") {
  const TinyRecipe recipe;
  const fs::path out = recipe.out("out");
  fs::create_directories(out / ".part/labels");
  write_file(out / ".part/labels/mine.txt", "mine");
  const Run run = recipe.run("out");
  CHECK_MESSAGE(run.status == 73, run.err);
  CHECK_MESSAGE(has(run.err, "which no dataset made"), run.err);
  CHECK(contents_of(out).size() == 1);
  const fs::path linked = recipe.out("linked");
  fs::create_directories(linked);
  fs::create_directory_symlink(out / ".part", linked / ".part");
  CHECK(recipe.run("linked").status == 73);
  CHECK(fs::is_symlink(linked / ".part"));
  CHECK(text_of(out / ".part/labels/mine.txt") == "mine");
}

TEST_CASE("a dataset whose staging folder a killed run has left goes on") {
  const TinyRecipe recipe;
  const fs::path part = fs::path(recipe.out("out")) / ".part";
  fs::create_directories(part / "new/red LR");
  write_file(part / "new/red LR/half.mkv", "half");
  write_file(part / "1-of-1.lock", "");
  CHECK(recipe.run("out").status == 0);
  CHECK_FALSE(fs::exists(part));
}

TEST_CASE("an own-body mask among the images to be replaced is refused, by any of its names") {
  const ExistingImages there;
  write_image(there.image("frame_000099.png"));
  const std::string mask = "--set footage.own_body_mask=";
  there.check_refused("frame_000099.png", mask + there.image("frame_000099.png"));
  fs::create_symlink(there.image("frame_000099.png"), there.tiny.file("link.png"));
  there.check_refused("link.png", mask + there.tiny.file("link.png").string());
  fs::create_hard_link(there.image("frame_000099.png"), there.tiny.file("second.png"));
  there.check_refused("second.png", mask + there.tiny.file("second.png").string());
  fs::remove(there.image("frame_000099.png"));
  write_image(there.tiny.file("real.png"));
  fs::create_symlink(there.tiny.file("real.png"), there.image("frame_000099.png"));
  there.check_refused("frame_000099.png", mask + there.image("frame_000099.png"));
}

TEST_CASE("textures, MTL files and footage among the images to be replaced are refused") {
  const ExistingImages there;
  write_image(there.image("frame_000098.png"));
  write_file(there.tiny.file("cube.mtl"), "newmtl paint\nKd 1 1 1\nmap_Kd out/tiny/frame_000098.png\n");
  there.check_refused("frame_000098.png");
  fs::remove(there.image("frame_000098.png"));
  fs::rename(there.tiny.file("cube.mtl"), there.image("frame_000098.png"));
  std::string obj = text_of(there.tiny.file("cube.obj"));
  write_file(there.tiny.file("cube.obj"), obj.replace(obj.find("cube.mtl"), 8, "out/tiny/frame_000098.png"));
  there.check_refused("frame_000098.png");
  fs::copy_file(there.tiny.file("clip.mkv"), there.image("frame_000097.png"));
  there.check_refused("frame_000097.png", "--set footage.video=" + there.image("frame_000097.png"));
}

TEST_CASE("a frame does not replace what its project reads") {
  const TinyProject tiny;
  write_image(tiny.file("frame_3.png"));
  const std::string mask = text_of(tiny.file("frame_3.png"));
  const Run run = run_sigs("frame " + tiny.project() + " --frame 3 --force --set footage.own_body_mask=frame_3.png" +
                           " --out " + tiny.file("").string());
  CHECK_MESSAGE(run.status == 73, run.err);
  CHECK_MESSAGE(has(run.err, "is read by this command"), run.err);
  CHECK(text_of(tiny.file("frame_3.png")) == mask);
}

TEST_CASE("a mask's steps do not replace its footage, whatever it is called") {
  const TemporaryFolder folder;
  fs::create_directories(folder / "steps");
  write_flight(folder / "clip.mkv", 10);
  fs::rename(folder / "clip.mkv", folder / "steps/07_labels.png");
  fs::create_hard_link(folder / "steps/07_labels.png", folder / "second.mkv");
  const std::string footage = text_of(folder / "second.mkv");
  for (const char* const video : {"steps/07_labels.png", "second.mkv"}) {
    const Run run = run_sigs("mask " + (folder / video).string() + " --method paper --force --out " +
                             (folder / "m.png").string() + " --stages " + (folder / "steps").string());
    CHECK_MESSAGE(run.status == 73, run.err);
    CHECK_MESSAGE(has(run.err, "is read by this command"), run.err);
    REQUIRE(fs::exists(folder / "steps/07_labels.png"));
    CHECK(text_of(folder / "steps/07_labels.png") == footage);
  }
}

TEST_CASE("a file is not replaced by a folder of its name, nor a folder or a FIFO by a file") {
  const TinyProject tiny;
  fs::create_directories(tiny.out());
  write_file(tiny.out() + "/tiny", "mine");
  const Run folder = run_sigs("export " + tiny.project() + " --codec png --masks none --force --out " + tiny.out());
  CHECK_MESSAGE(folder.status == 73, folder.err);
  CHECK(text_of(tiny.out() + "/tiny") == "mine");
  REQUIRE(mkfifo((tiny.out() + "/tiny.xml").c_str(), 0600) == 0);
  const Run fifo = run_sigs_after(kPatience, "export " + tiny.project() + " --force --out " + tiny.out());
  CHECK_MESSAGE(fifo.status == 73, fifo.err);
  CHECK(fs::is_fifo(tiny.out() + "/tiny.xml"));
  CHECK(tiny.files_out() == 2);
}

TEST_CASE("names that cannot be file names are refused before anything is written") {
  TinyProject tiny;
  const auto refused = [&](const std::string& more) {
    const Run run = run_sigs("export " + tiny.project() + " --out " + tiny.out() + " " + more);
    CHECK_MESSAGE(run.status == 78, more << ": " << run.err);
    CHECK_MESSAGE(has(run.err, "p.json: name: "), run.err);
    CHECK(std::count(run.err.begin(), run.err.end(), '\n') == 1);
    CHECK(tiny.files_out() == 0);
    CHECK(run_sigs("check " + tiny.project() + " " + more).status == 78);
  };
  for (const std::string& name : {std::string("."), std::string(".."), std::string("a/b"), std::string(201, 'n')})
    refused("--set name=" + name);
  refused("--set \"name=$(printf 'a\\nb')\"");
  refused("--set \"name=$(printf 'a\\033b')\"");
  refused("--set name=");
  tiny.change(R"("name": "tiny")", R"("name": "tiny\u0000.mkv")");
  refused("");
  tiny.change(R"("name": "tiny\u0000.mkv")", R"("name": "tiny\u007f")");
  refused("");
}

// Names that would lead out of a folder, or break a line, if a file were called so.
TEST_CASE("whatever a stranger's project calls its intruders, nothing is written outside of the output folder") {
  for (const std::string& name : {std::string("../../../evil"), std::string("/tmp/sigs-evil"), std::string("a\\nb"),
                                  std::string("a\\u0000b"), std::string(5000, 'n')}) {
    TinyProject tiny;
    tiny.change(R"("name": "cube")", R"("name": ")" + name + R"(", "category": ")" + name + "\"");
    std::string labels;
    for (const LabelFormat& format : label_formats()) labels += (labels.empty() ? "" : ",") + std::string(format.name);
    const std::map<std::string, std::string> before = contents_of(tiny.file(""));
    const Run run = run_sigs("export " + tiny.project() + " --codec png --masks png --labels " + labels + " --out '" +
                             tiny.out() + "'");
    CHECK_MESSAGE((run.status == 0 || run.status == 78), run.err);
    fs::remove_all(tiny.out());
    CHECK(contents_of(tiny.file("")) == before);
    CHECK_FALSE(fs::exists("/tmp/sigs-evil"));
  }
}

TEST_CASE("an output whose name is a link to somewhere else replaces the link, and nothing is written there") {
  const TinyProject tiny;
  REQUIRE(run_sigs("export " + tiny.project() + " --out '" + tiny.out() + "'").status == 0);
  fs::create_directory(tiny.file("elsewhere"));
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(tiny.out())) names.push_back(entry.path().filename().string());
  for (const std::string& name : names) {
    fs::rename(fs::path(tiny.out()) / name, tiny.file("elsewhere") / name);
    fs::create_symlink(tiny.file("elsewhere") / name, fs::path(tiny.out()) / name);
  }
  const std::map<std::string, std::string> before = contents_of(tiny.file("elsewhere"));
  const Run run = run_sigs("export " + tiny.project() + " --set light.ambient=1 --force --out '" + tiny.out() + "'");
  CHECK_MESSAGE(run.status == 0, run.err);
  CHECK(contents_of(tiny.file("elsewhere")) == before);
  for (const std::string& name : names) CHECK_FALSE(fs::is_symlink(fs::path(tiny.out()) / name));
}

TEST_CASE("a dataset's folder that is a link to somewhere else is not written into") {
  const TinyRecipe recipe;
  REQUIRE(recipe.run("set", "").status == 0);
  const fs::path set = recipe.file("set");
  fs::rename(set / "red LR", recipe.file("elsewhere"));
  fs::create_directory_symlink(recipe.file("elsewhere"), set / "red LR");
  fs::remove(recipe.file("elsewhere") / "red LR.xml");
  const std::map<std::string, std::string> before = contents_of(recipe.file("elsewhere"));
  const Run run = recipe.run("set", "--resume");
  CAPTURE(run.status);
  CAPTURE(run.err);
  CHECK(contents_of(recipe.file("elsewhere")) == before);
}

}  // namespace sigs::test

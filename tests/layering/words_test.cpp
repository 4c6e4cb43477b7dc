// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>
#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "support/test_data.h"

namespace fs = std::filesystem;

namespace {

// An obsolete word of the project's early code, replaced by the field's own term.
struct GoneWord {
  const char* words;                         // lower case, one or several in a row, also as parts of an identifier
  const char* say;                           // the term to use
  std::vector<std::string> allowed_in = {};  // lines that hold one of these: names in files that are written
};

const std::vector<GoneWord>& gone_words() {
  static const std::vector<std::string> kStageName = {"\"bent\"", "1_bent", "_bent\"", "bent.png",
                                                      "_bent`",   "`bent`", "\"Bent\""};
  static const std::vector<std::string> kWritten = {
      "in_picture",    "in the picture", "same pictures",      "AV_PICTURE",        "picture_width",   "picture_height",
      "picture order", "\"pictures\"",   "groups of pictures", "group of pictures", "hidden pictures", "whole picture"};
  static const std::vector<std::string> kFilmInReports = {"\"film\"",  "\"films\"",    " film\"", " films\"",
                                                          "\"Films\"", "hour of film", ",film,",  "film.mkv"};
  static const std::vector<GoneWord> kAll = {
      {"sitter", "rendered intruder"},
      {"sitting", "rendered intruder"},
      {"laid on", "composited"},
      {"lay on", "composite", {"lay on disk"}},
      {"bent", "warped", kStageName},
      {"soften", "blur"},
      {"softened", "blurred"},
      {"softening", "blur"},
      {"far blur", "wide blur"},
      {"picture", "image, texture or frame", kWritten},
      {"pictures", "images, textures or frames", kWritten},
      {"bench context", "ComposeContext"},
      {"outlook", "visibility estimate"},
      {"outlooks", "visibility estimates"},
      {"sighting", "visibility estimate"},
      {"sightings", "visibility estimates"},
      {"stand in", "placeholder", {"\"stand-in\"", " stand in ", "stand in `", "stand in:"}},
      {"stand ins", "placeholders"},
      {"mended", "sanitized, repaired"},
      {"shelf", "cache"},
      {"footage book", "footage cache"},
      {"workshop", "staging folder"},
      {"hidden side", "cull face"},
      {"stiffness", "conditioning"},
      {"file desk", "project session"},
      {"front desk", "app shell"},
      {"studio", "view context"},
      {"least pixels",
       "--min-pixels",
       {"label_least_pixels", "least_pixels`", "export least pixels", "\"least pixels\"", "/least pixels",
        "Least pixels", "\"least_pixels\""}},
      {"least score", "--min-score", {"\"least_score\""}},
      {"least visible",
       "--min-visible",
       {"least_visible", "export least visible", "\"least visible\"", "##least visible", "/least visible",
        "Least visible"}},
      {"longest range", "--max-range", {"\"longest_range_m\"", "the longest range"}},
      {"longest gap", "--max-gap", {"\"longest_gap_s\""}},
      {"desk", "session, shell"},
      {"film", "clip, video", kFilmInReports},
      {"films", "clips, videos", kFilmInReports},
      {"sound frame", "intact frame"},
      {"sound frames", "intact frames"},
      {"sound one", "intact one"},
      {"soundly", "intact"},
      {"made flights", "synthetic flights"},
      {"ghost", "second image, image beyond the fold"},
      {"ghosts", "second image, image beyond the fold"},
      {"told apart", "distinguished"},
      {"doubted", "warned of"},
      {"lets go", "releases, discards, evicts"},
      {"same road", "same code"},
      {"another road", "another method"},
      {"twins", "reference implementations"},
  };
  return kAll;
}

// The words of a line in lower case, each after a space: "kFooBar_baz" -> " k foo bar baz ".
std::string words_of(const std::string& line) {
  std::string words = " ";
  char before = ' ';
  for (const char c : line) {
    const bool is_letter = std::isalpha(static_cast<unsigned char>(c)) != 0;
    const bool begins = is_letter && std::isupper(static_cast<unsigned char>(c)) != 0 &&
                        std::islower(static_cast<unsigned char>(before)) != 0;
    if ((!is_letter || begins) && words.back() != ' ') words += ' ';
    if (is_letter) words += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    before = c;
  }
  return words + ' ';
}

// The first word in a line that is gone; nullptr if there is none.
const GoneWord* gone_word_in(const std::string& line) {
  const std::string words = words_of(line);
  for (const GoneWord& gone : gone_words()) {
    if (words.find(" " + std::string(gone.words) + " ") == std::string::npos) continue;
    const bool is_allowed = std::any_of(gone.allowed_in.begin(), gone.allowed_in.end(),
                                        [&](const std::string& part) { return line.find(part) != std::string::npos; });
    if (!is_allowed) return &gone;
  }
  return nullptr;
}

bool is_searched(const fs::path& path) {
  const std::string extension = path.extension().string();
  return extension == ".h" || extension == ".cpp" || extension == ".md" || extension == ".txt" || extension == ".sh" ||
         extension == ".cmake";
}

// What H.264 codes is a picture; the decoder's own files speak of it so.
bool is_coded_picture(const fs::path& file, const std::string& line) {
  const bool is_decoder = file.generic_string().find("/video/") != std::string::npos;
  return is_decoder && line.find("icture") != std::string::npos;
}

std::vector<fs::path> searched_files() {
  std::vector<fs::path> files;
  const fs::path root = sigs::test::source_dir();
  for (const char* const folder : {"engine", "editor", "cli", "tests", "bench", "docs", "scripts", "cmake", "projects"})
    for (const auto& entry : fs::recursive_directory_iterator(root / folder))
      if (entry.is_regular_file() && is_searched(entry.path()) && entry.path().filename() != "words_test.cpp")
        files.push_back(entry.path());
  for (const char* const file : {"README.md", "CONTRIBUTING.md"}) files.push_back(root / file);
  return files;
}

}  // namespace

TEST_CASE("no file contains an obsolete word") {
  const fs::path root = sigs::test::source_dir();
  const std::vector<fs::path> files = searched_files();
  REQUIRE(files.size() > 500);
  for (const fs::path& file : files) {
    std::ifstream in(file);
    int number = 0;
    for (std::string line; std::getline(in, line);) {
      ++number;
      if (is_coded_picture(file, line)) continue;
      if (const GoneWord* const gone = gone_word_in(line))
        FAIL_CHECK(file.lexically_relative(root).generic_string()
                   << ":" << number << ": \"" << std::string(gone->words) << "\"; say " << std::string(gone->say));
    }
  }
}

TEST_CASE("the check itself finds an obsolete word and accepts plain English") {
  CHECK(gone_word_in("cv::Mat picture_of(const Frame& frame);") != nullptr);
  CHECK(gone_word_in("// The sitter is warped by the lens.") != nullptr);
  CHECK(gone_word_in("sigs export x.json --least-pixels 4") != nullptr);
  CHECK(gone_word_in("struct FileDesk {") != nullptr);
  CHECK(gone_word_in("// At least one frame is kept, in order of time.") == nullptr);
  CHECK(gone_word_in("node.append_attribute(\"in_picture\")") == nullptr);
}

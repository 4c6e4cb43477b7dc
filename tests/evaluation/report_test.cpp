// SPDX-License-Identifier: MIT
#include "evaluation/reports/report.h"

#include <doctest/doctest.h>

#include <cstdlib>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <pugixml.hpp>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "base/staged_outputs.h"
#include "base/text.h"
#include "evaluation/synthetic_report.h"
#include "support/files.h"
#include "support/test_data.h"

namespace sigs::test {
namespace {

namespace fs = std::filesystem;
using Row = std::map<std::string, std::string>;

// A reader of CSV of its own (RFC 4180): fields in quotes may hold commas and doubled quotes.
std::vector<Row> rows_of(const std::string& text) {
  std::vector<std::vector<std::string>> lines(1, std::vector<std::string>(1));
  bool is_quoted = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (is_quoted && c == '"' && i + 1 < text.size() && text[i + 1] == '"')
      lines.back().back() += text[++i];
    else if (c == '"')
      is_quoted = !is_quoted;
    else if (!is_quoted && c == ',')
      lines.back().emplace_back();
    else if (!is_quoted && c == '\n')
      lines.emplace_back(1);
    else
      lines.back().back() += c;
  }
  lines.pop_back();
  std::vector<Row> rows;
  for (std::size_t line = 1; line < lines.size(); ++line) {
    REQUIRE(lines[line].size() == lines[0].size());
    rows.emplace_back();
    for (std::size_t i = 0; i < lines[0].size(); ++i) rows.back()[lines[0][i]] = lines[line][i];
  }
  return rows;
}

template <class Report>
struct Written {
  TemporaryFolder folder;
  WrittenReport report;

  explicit Written(const Report& made) {
    Result<WrittenReport> written = write_report(folder.path(), made);
    REQUIRE_MESSAGE(written.has_value(), written.error().text());
    report = std::move(*written);
  }
  [[nodiscard]] std::string text(const std::string& name) const { return text_of(folder / name); }
  [[nodiscard]] std::map<std::string, std::string> all() const { return contents_of(folder.path()); }
};

double number(const std::string& text) {
  return std::stod(text);
}

// Everything that a reader would fetch: sources, links, imports.
void check_self_contained(const pugi::xml_node& node) {
  const std::set<std::string> elements{"link", "script", "img", "iframe", "object", "embed", "base", "image", "form"};
  CHECK_MESSAGE(!elements.contains(node.name()), node.name());
  for (const pugi::xml_attribute& attribute : node.attributes()) {
    const std::string name = attribute.name();
    const std::string value = attribute.value();
    CHECK(name != "src");
    if (name == "href" || name == "xlink:href") CHECK_MESSAGE(value.starts_with("#"), value);
    if (value.find("url(") != std::string::npos) CHECK_MESSAGE(value.find("url(#") != std::string::npos, value);
    if (value.find("://") != std::string::npos)
      CHECK_MESSAGE((name.starts_with("xmlns") && value.starts_with("http://www.w3.org/")), value);
  }
  const std::string text = node.text().get();
  if (std::string(node.name()) == "style") {
    CHECK(text.find("@import") == std::string::npos);
    CHECK(text.find("url(") == std::string::npos);
  }
  for (const pugi::xml_node& child : node.children()) check_self_contained(child);
}

void collect_ids(const pugi::xml_node& node, std::map<std::string, int>& ids) {
  if (const pugi::xml_attribute id = node.attribute("id")) ++ids[id.value()];
  for (const pugi::xml_node& child : node.children()) collect_ids(child, ids);
}

pugi::xml_document parsed(const std::string& text) {
  pugi::xml_document document;
  const pugi::xml_parse_result result = document.load_string(text.c_str(), pugi::parse_default | pugi::parse_doctype);
  REQUIRE_MESSAGE(result, result.description());
  return document;
}

std::vector<std::string> words(const std::string& line) {
  std::istringstream in(line);
  std::vector<std::string> found;
  for (std::string word; in >> word;) found.push_back(word);
  return found;
}

}  // namespace

TEST_CASE("a tracker off by (3, 4) px has a centre error of 5 in the table, in CSV and in JSON") {
  const TrackReport report = synthetic_track_report();
  std::istringstream table(table_text(report));
  std::string line;
  for (int i = 0; i < 3; ++i) std::getline(table, line);
  const std::vector<std::string> cells = words(line);
  REQUIRE(cells.size() == 14);
  CHECK(cells[0] == "off");
  CHECK(std::vector<std::string>(cells.begin() + 1, cells.begin() + 6) ==
        std::vector<std::string>{"5.00", "5.00", "5.00", "3.00", "4.00"});
  CHECK(cells[6] == "25");
  CHECK(cells[7] == "1.000*");
  CHECK(cells[10] == "0*");
  CHECK(cells[11] == "25");  // hidden in five of the thirty
  CHECK(cells[12] == "5");
  CHECK(cells[13] == "12.5");

  const Written written(report);
  const Row summary = rows_of(written.text("summary.csv")).front();
  for (const char* const column : {"mean_center_error_px", "median_center_error_px", "p95_center_error_px"})
    CHECK(number(summary.at(column)) == doctest::Approx(5).epsilon(1e-12));
  CHECK(number(summary.at("mean_x_error_px")) == doctest::Approx(3).epsilon(1e-12));
  CHECK(number(summary.at("mean_y_error_px")) == doctest::Approx(4).epsilon(1e-12));
  CHECK(summary.at("measured_frames_per_s") == "12.5");
  int scored = 0;
  for (const Row& row : rows_of(written.text("frames.csv"))) {
    if (row.at("tracker") != "off" || row.at("is_scored") != "1") continue;
    ++scored;
    CHECK(number(row.at("center_error_px")) == doctest::Approx(5).epsilon(1e-12));
    const auto middle = [&](const std::string& whose, const char* place, const char* extent) {
      return number(row.at(whose + place)) + number(row.at(whose + extent)) / 2;
    };
    CHECK(middle("reported", "_x_px", "_width_px") - middle("true", "_x_px", "_width_px") == doctest::Approx(3));
    CHECK(middle("reported", "_y_px", "_height_px") - middle("true", "_y_px", "_height_px") == doctest::Approx(4));
    // Calculated manually: the left edge lies at 100.5 px + 2 px a frame, so its first column is the next half pixel.
    CHECK(number(row.at("true_x_px")) == doctest::Approx(101 + 2 * number(row.at("frame"))));
    CHECK(number(row.at("true_width_px")) == 40);
    CHECK(number(row.at("distance_m")) == 800 - 10 * number(row.at("frame")));
  }
  CHECK(scored == 25);
  const nlohmann::json json = nlohmann::json::parse(written.text("evaluation.json"));
  CHECK(json["trackers"][0]["mean_center_error_px"].get<double>() == doctest::Approx(5).epsilon(1e-12));
  const nlohmann::json& precision = json["trackers"][0]["precision"];
  REQUIRE(precision["thresholds"].size() == 51);
  CHECK(precision["thresholds"][5] == 5.0);
  CHECK(precision["shares"][4] == 0.0);
  CHECK(precision["shares"][6] == 1.0);
}

TEST_CASE("a tracker without reports has no errors: a dash, an empty field, null") {
  const TrackReport report = synthetic_track_report();
  CHECK(table_text(report).find("\nsilent") != std::string::npos);
  const Written written(report);
  const Row silent = rows_of(written.text("summary.csv")).at(2);
  CHECK(silent.at("tracker") == "silent");
  CHECK(silent.at("mean_center_error_px").empty());
  CHECK(silent.at("lost_frames") == "25");
  CHECK(silent.at("measured_frames_per_s").empty());
  const nlohmann::json json = nlohmann::json::parse(written.text("evaluation.json"));
  CHECK(json["trackers"][2]["mean_center_error_px"].is_null());
  CHECK(json["trackers"][2]["measured_frames_per_s"].is_null());
  CHECK(json["trackers"][2]["precision_at_20_px"] == 0.0);
}

TEST_CASE("a name comes back from CSV, JSON and the page as it is") {
  const Written written(synthetic_track_report());
  CHECK(rows_of(written.text("summary.csv")).at(1).at("tracker") == kSpecialName);
  const nlohmann::json json = nlohmann::json::parse(written.text("evaluation.json"));
  CHECK(json["trackers"][1]["name"] == kSpecialName);
  CHECK(json["video"] == "clip <1>");
  const pugi::xml_document page = parsed(written.text("report.html"));
  CHECK(page.select_node("//tbody/tr[2]/td[1]").node().text().get() == std::string(kSpecialName));
  CHECK(page.select_node("//h1").node().text().get() == std::string("Trackers on clip <1>"));
}

TEST_CASE("the page refers to no other file, contains policies and remarks, and has no id twice") {
  const Written written(synthetic_track_report());
  const pugi::xml_document page = parsed(written.text("report.html"));
  check_self_contained(page.document_element());
  std::map<std::string, int> ids;
  collect_ids(page, ids);
  for (const auto& entry : ids) CHECK_MESSAGE(entry.second == 1, entry.first);
  std::set<std::string> items;
  for (const pugi::xpath_node& item : page.select_nodes("//li")) items.insert(item.node().text().get());
  for (const std::string& policy : policies_of(synthetic_track_report())) CHECK_MESSAGE(items.contains(policy), policy);
  CHECK(items.contains(synthetic_track_report().remarks.front()));
  CHECK(page.select_nodes("//figure/svg").size() == 6);
}

TEST_CASE("plots are whole images, with every tracker in the key") {
  const Written written(synthetic_track_report());
  CHECK(written.report.files.size() == 16);
  for (const char* const name :
       {"center_error", "x_error", "y_error", "precision", "success", "normalized_precision"}) {
    const pugi::xml_document svg = parsed(written.text(std::string(name) + ".svg"));
    std::string texts;
    for (const pugi::xpath_node& text : svg.select_nodes("//text"))
      texts += std::string(text.node().text().get()) + "\n";
    for (const std::string& tracker : {std::string("off"), line_text(kSpecialName), std::string("silent")})
      CHECK_MESSAGE(texts.find(tracker) != std::string::npos, name << texts);
    CHECK_MESSAGE(written.text(std::string(name) + ".png").starts_with("\x89PNG"), name);
  }
}

TEST_CASE("the same report gives the same bytes") {
  CHECK(Written(synthetic_track_report()).all() == Written(synthetic_track_report()).all());
  CHECK(Written(synthetic_detection_report()).all() == Written(synthetic_detection_report()).all());
}

TEST_CASE("a report cannot be written into a folder that does not exist") {
  const TemporaryFolder folder;
  const Result<WrittenReport> written = write_report(folder / "nowhere", synthetic_track_report());
  REQUIRE_FALSE(written.has_value());
  CHECK(written.error().kind == ErrorKind::cannot_create);
}

TEST_CASE("the best of a column is marked where there is one, and errors have none") {
  TrackReport report = synthetic_track_report();
  std::istringstream table(table_text(report));
  std::string line;
  std::getline(table, line);
  CHECK(line.find("success ") != std::string::npos);
  const std::string text = table_text(report);
  CHECK(text.find("5.00*") == std::string::npos);
  CHECK(text.find("0.00*") == std::string::npos);
  report.scores = {report.scores.front()};
  CHECK(table_text(report).find('*') == std::string::npos);
  report.scores.push_back(report.scores.front());
  CHECK(table_text(report).find('*') == std::string::npos);
}

TEST_CASE("no mean error is shown where fewer than half of the frames have a report, and a note gives the reason") {
  TrackReport report = synthetic_track_report();
  report.scores[1].reported = 3;  // of 25
  const std::string text = table_text(report);
  CHECK(text.find("0.00?") == std::string::npos);  // a tracker that gives up at once is not the best one
  CHECK(text.find("-?") != std::string::npos);
  CHECK(text.find("5.00?") == std::string::npos);
  CHECK(text.find("\n* best of its column\n? no figure: fewer than half of the frames scored") != std::string::npos);
  report.scores[1].reported = 13;
  CHECK(table_text(report).find('?') == std::string::npos);
}

TEST_CASE("a table's columns end below each other, whatever the letters of the names") {
  const TrackReport report = synthetic_track_report();
  std::istringstream table(table_text(report));
  std::set<std::size_t> places;
  std::string line;
  while (std::getline(table, line)) {
    if (line.find("frames/s") != std::string::npos) continue;
    std::size_t columns = 0;
    for (const char c : line) columns += (static_cast<unsigned char>(c) & 0xC0U) != 0x80U;
    if (line.ends_with("12.5") || line.ends_with("-")) places.insert(columns);
  }
  CHECK(places.size() == 1);
}

TEST_CASE("a report of detectors has the same figures in the table, in CSV and in JSON") {
  const DetectionReport report = synthetic_detection_report();
  const std::string table = table_text(report);
  CHECK(table.find("1.000 (1/1)*") != std::string::npos);
  CHECK(table.find("0.000 (0/1)") != std::string::npos);
  CHECK(table.find("- (0/0)") != std::string::npos);
  const Written written(report);
  const std::vector<Row> summary = rows_of(written.text("summary.csv"));
  CHECK(summary.at(0).at("detector") == kSpecialName);
  CHECK(summary.at(0).at("false_alarms_per_hour") == "1800");
  CHECK(summary.at(1).at("mean_first_range_m").empty());
  const std::vector<Row> encounters = rows_of(written.text("encounters.csv"));
  CHECK(encounters.at(0).at("video") == "one, \"1\"");
  CHECK(encounters.at(0).at("first_detection_range_m") == "512.25");
  CHECK(encounters.at(1).at("first_detection_range_m").empty());
  CHECK(encounters.at(0).at("horizon") == "above");
  const nlohmann::json json = nlohmann::json::parse(written.text("evaluation.json"));
  CHECK(json["detectors"][0]["encounter_detection_rate"]["all"]["rate"] == 1.0);
  CHECK(json["detectors"][0]["encounter_detection_rate"]["on_horizon"]["rate"].is_null());
  CHECK(json["detectors"][1]["encounters"][0]["is_detected"] == false);
  const pugi::xml_document page = parsed(written.text("report.html"));
  check_self_contained(page.document_element());
  CHECK(page.select_nodes("//table[2]/tbody/tr | //div[2]/table/tbody/tr").size() == 2);
  CHECK(page.select_nodes("//figure/svg").size() == 2);
}

TEST_CASE("the files of a report are recognized by name, and no others") {
  const Written track(synthetic_track_report());
  const Written detect(synthetic_detection_report());
  for (const auto* const names : {&track.report.files, &detect.report.files})
    for (const fs::path& file : *names) CHECK_MESSAGE(is_report_file(file.filename().string()), file.string());
  for (const char* const strange : {"thesis.csv", "center_error.pdf", "center_error", ".svg", "report.html.bak", ""})
    CHECK_FALSE_MESSAGE(is_report_file(strange), strange);
}

}  // namespace sigs::test

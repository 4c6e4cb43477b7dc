// SPDX-License-Identifier: MIT
#include "dataset/design_domain.h"

#include <doctest/doctest.h>

#include <nlohmann/json.hpp>
#include <set>

#include "base/random.h"
#include "dataset/domain_coverage.h"
#include "docs/markdown.h"
#include "support/files.h"
#include "support/test_data.h"

using namespace sigs;
using namespace sigs::test;

namespace {

DesignDomain domain_from(const std::string& conditions, const std::string& more = "") {
  const Result<ReadDomain> read =
      parse_design_domain(R"({"sigs_domain": 1, "conditions": )" + conditions + more + "}", "odd.json");
  REQUIRE_MESSAGE(read, read.error().text());
  CHECK(read->warnings.empty());
  return read->domain;
}

std::string domain_error(const std::string& text) {
  const Result<ReadDomain> read = parse_design_domain(text, "odd.json");
  return read ? "" : read.error().text();
}

std::string error_of_conditions(const std::string& conditions) {
  return domain_error(R"({"sigs_domain": 1, "conditions": )" + conditions + "}");
}

// One intruder in one frame, as an annotation states it.
struct WrittenBody {
  int id = 0;
  double x_m = 100, y_m = 0, z_m = 0;  // in the camera frame
  double yaw_deg = 180;                // in the world
  std::string horizon = "above";
  bool is_seen = true;
  std::string attributes = {};  // further ones
  std::string elements = {};
};

std::string element_of(const WrittenBody& body) {
  const std::string range_m =
      std::to_string(std::sqrt(body.x_m * body.x_m + body.y_m * body.y_m + body.z_m * body.z_m));
  return "<intruder id=\"" + std::to_string(body.id) + "\" name=\"x\" horizon=\"" + body.horizon + "\" " +
         body.attributes + "><position x_m=\"" + std::to_string(body.x_m) + "\" y_m=\"" + std::to_string(body.y_m) +
         "\" z_m=\"" + std::to_string(body.z_m) + "\"/><distance m=\"" + range_m +
         "\"/><attitude roll_deg=\"0\" pitch_deg=\"0\" yaw_deg=\"" + std::to_string(body.yaw_deg) + "\"/>" +
         (body.is_seen ? "<box x=\"1\" y=\"2\" width=\"3\" height=\"3\" pixels=\"4\"/>" : "") +
         "<silhouette x=\"0\" y=\"0\" width=\"20\" height=\"1\"/>" + body.elements + "</intruder>";
}

using Frames = std::vector<std::vector<WrittenBody>>;  // a second apart

// A dataset that consists of an index and annotations alone.
class WrittenDataset {
 public:
  void add(const std::string& name, const Frames& frames, const nlohmann::json& tags,
           const std::vector<std::string>& kinds, double camera_yaw_deg = 0) {
    index_["videos"].push_back({{"name", name}, {"tags", tags}});
    std::filesystem::create_directories(folder_ / name);
    nlohmann::json project;
    for (const std::string& kind : kinds) project["intruders"].push_back({{"category", kind}});
    write_file(folder_ / (name + "/" + name + ".json"), project.dump());
    std::string text = "<sigs version=\"1\">";
    for (std::size_t i = 0; i < frames.size(); ++i) {
      text += "<frame index=\"" + std::to_string(i) + "\" time_s=\"" + std::to_string(i) +
              "\"><camera x_m=\"0\" y_m=\"0\" z_m=\"0\" roll_deg=\"0\" pitch_deg=\"0\" yaw_deg=\"" +
              std::to_string(camera_yaw_deg) + "\"/>";
      for (const WrittenBody& body : frames[i]) text += element_of(body);
      text += "</frame>";
    }
    write_file(folder_ / (name + "/" + name + ".xml"), text + "</sigs>");
  }

  [[nodiscard]] DomainCoverage counted(const DesignDomain& domain) const {
    write_file(folder_ / "index.json", index_.dump());
    Result<DomainCoverage> coverage = counted_domain_coverage(domain, folder_.path());
    REQUIRE_MESSAGE(coverage, coverage.error().text());
    return *std::move(coverage);
  }

 private:
  TemporaryFolder folder_;
  nlohmann::json index_{{"videos", nlohmann::json::array()}};
};

using Counts = std::vector<DomainCount>;

}  // namespace

TEST_CASE("frames and encounters of known annotations are counted in the bins of each condition") {
  WrittenDataset dataset;
  // Going away at 100 m/s, head-on; the second body is seen once; a distractor does not count.
  dataset.add("v",
              {{{.x_m = 100}, {.id = 1, .y_m = 100}, {.id = 2, .attributes = "role=\"distractor\""}},
               {{.x_m = 200}, {.id = 1, .y_m = 100, .is_seen = false}},
               {{.x_m = 300, .horizon = "unknown"}, {.id = 1, .y_m = 100, .is_seen = false}}},
              {{"light", "dawn"}}, {"airplane", "helicopter", "bird"});
  const DesignDomain domain = domain_from(R"({
    "range_m": {"bins": [100, 200, 300]}, "aspect_deg": {"bins": [0, 10, 170, 180]},
    "closing_speed_mps": {"bins": [-150, -50, 50]}, "bearing_deg": {"bins": [-10, 10, 44]},
    "horizon": {"values": ["above", "below"]}, "kind": {"values": ["helicopter"]},
    "light": {"values": ["dawn", "noon"]}, "weather": {"values": ["rain"]}, "camera_yaw_deg": {"bins": [-1, 1]}})");
  const DomainCoverage coverage = dataset.counted(domain);
  CHECK(coverage.videos == 1);
  CHECK(coverage.frames == 3);
  CHECK(coverage.in_view == DomainCount{4, 2});
  // 141 m and 100 m in the first bin; 200 m is the lower edge of the second, 300 m the upper edge of the last.
  CHECK(coverage.conditions[0].bins == Counts{{2, 2}, {2, 1}});
  CHECK(coverage.conditions[0].outside == DomainCount{0, 0});
  CHECK(coverage.conditions[1].bins == Counts{{3, 1}, {1, 1}, {0, 0}});  // the second body: 45 degrees
  CHECK(coverage.conditions[2].bins == Counts{{3, 1}, {1, 1}});          // the second one's distance stays
  CHECK(coverage.conditions[3].bins == Counts{{3, 1}, {0, 0}});
  CHECK(coverage.conditions[3].outside == DomainCount{1, 1});
  CHECK(coverage.conditions[4].bins == Counts{{3, 2}, {0, 0}});
  CHECK(coverage.conditions[4].untold == DomainCount{1, 1});
  CHECK(coverage.conditions[5].bins == Counts{{1, 1}});
  CHECK(coverage.conditions[5].outside == DomainCount{3, 1});
  CHECK(coverage.conditions[6].bins == Counts{{4, 2}, {0, 0}});
  CHECK(coverage.conditions[7].untold == DomainCount{4, 2});
  CHECK(coverage.conditions[8].bins == Counts{{3, 2}});  // where the horizon is not known the attitude is not
  CHECK(coverage.conditions[8].untold == DomainCount{1, 1});
  CHECK(coverage.outside == DomainCount{4, 2});  // kind or bearing
  const std::string text = domain_text(coverage, "counted");
  CHECK(text.find("2 encounters in view in 4 frames") != std::string::npos);
  CHECK(text.find("not told") != std::string::npos);
  CHECK(domain_plot(coverage, "counted").type() == CV_8UC3);
}

TEST_CASE("the aspect is against the camera wherever that looks, and a stated closing speed counts before distances") {
  WrittenDataset dataset;
  // The camera looks along world Y; the intruder flies there too: its tail is seen.
  dataset.add("tail", {{{.yaw_deg = 90, .elements = "<encounter closing_speed_mps=\"7\"/>"}}}, {}, {"airplane"}, 90);
  dataset.add("side", {{{.yaw_deg = 0}}}, {}, {"airplane"}, 90);
  const DomainCoverage coverage = dataset.counted(
      domain_from(R"({"aspect_deg": {"bins": [0, 89, 91, 179, 180]}, "closing_speed_mps": {"bins": [6, 8]}})"));
  CHECK(coverage.conditions[0].bins == Counts{{0, 0}, {1, 1}, {0, 0}, {1, 1}});
  CHECK(coverage.conditions[1].bins == Counts{{1, 1}});
  CHECK(coverage.conditions[1].untold == DomainCount{1, 1});  // a single frame tells no speed
}

TEST_CASE("pairs of bins are those of a brute-force count over all frames") {
  const std::vector<double> edges{0, 200, 500, 900};
  const std::vector<std::string> sides{"above", "on", "below"}, skies{"clear", "cloud"};
  struct Row {
    int encounter;
    double range_m;
    std::string side, sky;
  };
  std::vector<Row> rows;
  WrittenDataset dataset;
  Random random(4);
  for (int video = 0; video < 9; ++video) {
    const std::string sky = skies[random.bits() % 2];
    Frames frames(4);
    for (int id = 0; id < 2; ++id)
      for (std::vector<WrittenBody>& frame : frames) {
        const double range_m = 50 + std::floor(1000 * random.uniform());
        const std::string side = sides[random.bits() % 3];
        const bool is_seen = random.uniform() < 0.5;
        frame.push_back({.id = id, .x_m = range_m, .horizon = side, .is_seen = is_seen});
        if (is_seen) rows.push_back({2 * video + id, range_m, side, sky});
      }
    dataset.add("v" + std::to_string(video), frames, {{"sky", sky}}, {"airplane", "airplane"});
  }
  for (const int least : {1, 2}) {
    const DesignDomain domain = domain_from(
        R"({"range_m": {"bins": [0, 200, 500, 900]}, "horizon": {"values": ["above", "on", "below"]},
            "sky": {"values": ["clear", "cloud"]}})",
        R"(, "min_encounters": )" + std::to_string(least));
    const DomainCoverage coverage = dataset.counted(domain);
    // Cells as conditions on a row, two of each pair of conditions.
    using Test = std::function<bool(const Row&)>;
    std::vector<std::vector<Test>> tests(3);
    for (int bin = 0; bin < 3; ++bin)
      tests[0].push_back([&, bin](const Row& row) {
        const bool is_last = bin == 2;
        return row.range_m >= edges[std::size_t(bin)] &&
               (row.range_m < edges[std::size_t(bin) + 1] || (is_last && row.range_m == edges[3]));
      });
    for (const std::string& side : sides) tests[1].push_back([side](const Row& row) { return row.side == side; });
    for (const std::string& sky : skies) tests[2].push_back([sky](const Row& row) { return row.sky == sky; });
    long long covered = 0, all = 0;
    for (std::size_t a = 0; a < 3; ++a)
      for (std::size_t b = a + 1; b < 3; ++b)
        for (const Test& first : tests[a])
          for (const Test& second : tests[b]) {
            std::set<int> encounters;
            for (const Row& row : rows)
              if (first(row) && second(row)) encounters.insert(row.encounter);
            ++all;
            if (std::ssize(encounters) >= least) ++covered;
          }
    CHECK(coverage.pairs_covered() == std::pair{covered, all});
    CHECK(std::ssize(coverage.empty_pairs()) == all - covered);
    CHECK(covered > 0);
  }
}

TEST_CASE("zones leave out bins and pairs that no zone has, and frames in none of them are outside") {
  const DesignDomain domain = domain_from(
      R"({"range_m": {"bins": [0, 100, 200]}, "bearing_deg": {"bins": [-30, -10, 10, 30]}})",
      R"(, "zones": {"near": {"range_m": [0, 100]}, "far": {"range_m": [100, 200], "bearing_deg": [-10, 10]}})");
  CHECK(domain.has(0, 1, 1, 1));
  CHECK_FALSE(domain.has(0, 1, 1, 0));
  CHECK(domain.has(0, 0, 1, 0));
  WrittenDataset dataset;
  dataset.add("v", {{{.x_m = 50, .y_m = 20}}, {{.x_m = 150}}, {{.x_m = 150, .y_m = 50}}}, {}, {"airplane"});
  const DomainCoverage coverage = dataset.counted(domain);
  CHECK(coverage.outside == DomainCount{1, 1});
  CHECK(coverage.pairs_covered() == std::pair{2LL, 4LL});
}

TEST_CASE("a dataset without encounters covers nothing, and its share of pairs is not a number") {
  WrittenDataset dataset;
  dataset.add("v", {{{.is_seen = false}}, {}}, {}, {"airplane"});
  const DomainCoverage one = dataset.counted(domain_from(R"({"range_m": {"bins": [0, 100]}})"));
  CHECK(one.in_view == DomainCount{0, 0});
  CHECK(one.empty_bins().size() == 1);
  CHECK(nlohmann::json::parse(domain_json(one, "x"))["pairs"]["share"].is_null());
  CHECK(domain_text(one, "x").find("0 of 0 covered\n") != std::string::npos);
}

TEST_CASE("a number that is missing or no number is not told") {
  WrittenDataset dataset;
  dataset.add("v", {{{.x_m = std::nan("")}}}, {}, {"airplane"});
  const DomainCoverage coverage =
      dataset.counted(domain_from(R"({"range_m": {"bins": [0, 100]}, "bearing_deg": {"bins": [-1, 1]}})"));
  CHECK(coverage.conditions[0].untold == DomainCount{1, 1});
  CHECK(coverage.conditions[1].untold == DomainCount{1, 1});
}

TEST_CASE("mistakes in a design domain are errors that name the key") {
  const auto names = [](const std::string& error, const std::string& key) {
    return error.find(key) != std::string::npos && error.find('\n') == std::string::npos;
  };
  CHECK(names(error_of_conditions(R"({"range_m": {"bins": [1, 1]}})"), "conditions.range_m.bins[1]"));
  CHECK(names(error_of_conditions(R"({"range_m": {"bins": [3, 2]}})"), "edges must rise"));
  CHECK(names(error_of_conditions(R"({"range_m": {"bins": []}})"), "conditions.range_m.bins"));
  CHECK(names(error_of_conditions(R"({"range_m": {"bins": [1]}})"), "at least two"));
  CHECK(names(error_of_conditions(R"({"range_m": {"bins": [0, null]}})"), "expected a number"));
  CHECK(names(error_of_conditions(R"({"range_m": {"bins": [0, NaN]}})"), "odd.json"));
  CHECK(names(error_of_conditions(R"({"range_m": {"values": ["near"]}})"), "give \"bins\""));
  CHECK(names(error_of_conditions(R"({"rang_m": {"bins": [0, 1]}})"), "range_m"));
  CHECK(names(error_of_conditions(R"({"light": {"values": []}})"), "conditions.light.values"));
  CHECK(names(error_of_conditions(R"({"light": {"values": ["a", "a"]}})"), "twice"));
  CHECK(names(error_of_conditions(R"({"light": {}})"), "conditions.light"));
  CHECK(names(error_of_conditions(R"({"horizon": {"values": ["over"]}})"), "above, on, below"));
  CHECK(names(error_of_conditions("{}"), "conditions"));
  CHECK(names(domain_error("[]"), "odd.json"));
  CHECK(names(domain_error(""), "odd.json"));
  CHECK(names(domain_error(R"({"conditions": {"range_m": {"bins": [0, 1]}}})"), "sigs_domain"));
  CHECK(names(domain_error(R"({"sigs_domain": 1, "conditions": {"range_m": {"bins": [0, 1]}},
                               "zones": {"a": {"size_px": [0, 1]}}})"),
              "zones.a.size_px"));
  CHECK_FALSE(read_design_domain("/nowhere/odd.json"));
}

TEST_CASE("LARD's table becomes bins between all limits of its zones") {
  const std::string table =
      "ODD_Far:\n  max_distance_m: 6000\n  min_distance_m: 4500\n  alpha_h_min: -3\n  alpha_h_max: 3\n"
      "  yaw_min: -24\n  yaw_max: 24 \n  pitch_min: -15\n  pitch_max: 5\n  roll_min: -30\n  roll_max: 30\n  \n"
      "ODD_Close:  # the last part\n  max_distance_m: 4500\n  min_distance_m: 280\n  roll_min: -10\n  roll_max: 10\n";
  const Result<ReadDomain> read = parse_design_domain(table, "Lard_v2_Default_ODD.yaml");
  REQUIRE_MESSAGE(read, read.error().text());
  const DesignDomain& domain = read->domain;
  REQUIRE(domain.conditions.size() == 4);
  CHECK(domain.conditions[0].name == "range_m");
  CHECK(domain.conditions[0].edges == std::vector<double>{280, 4500, 6000});
  CHECK(domain.conditions[3].edges == std::vector<double>{-30, -10, 10, 30});
  CHECK_FALSE(domain.has(0, 0, 3, 0));  // near with a roll of -30 to -10
  CHECK(domain.has(0, 1, 3, 0));
  REQUIRE(read->warnings.size() == 2);
  CHECK(read->warnings[0].where.find("alpha_h") != std::string::npos);
  CHECK(domain_error("ODD:\n  yaw_min: 3\n").find("ODD.yaw") != std::string::npos);
  CHECK(domain_error("ODD:\n  roll_min: x\n  roll_max: 1\n").find("ODD.roll_min") != std::string::npos);
  CHECK(domain_error("just a text").find("line 1") != std::string::npos);
}

TEST_CASE("the design domain on its page is read, with zones that leave pairs out") {
  const std::vector<std::string> examples = blocks(page("design-domain.md"), "json");
  REQUIRE(examples.size() == 1);
  const Result<ReadDomain> read = parse_design_domain(examples[0], "domain.json");
  REQUIRE_MESSAGE(read, read.error().text());
  CHECK(read->warnings.empty());
  CHECK(read->domain.conditions.size() == 7);
  CHECK(read->domain.min_encounters == 2);
  CHECK_FALSE(read->domain.has(0, 2, 3, 0));
  for (const char* const name : kDomainNumberNames)
    CHECK(page("design-domain.md").find('`' + std::string(name) + '`') != std::string::npos);
}

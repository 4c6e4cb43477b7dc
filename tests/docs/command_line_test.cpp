// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <map>
#include <regex>
#include <set>
#include <string>

#include "docs/markdown.h"
#include "support/process.h"
#include "support/test_data.h"

namespace sigs::test {
namespace {

// Each run once.
const std::string& help_of(const std::string& verb) {
  static std::map<std::string, std::string> known;
  if (const auto found = known.find(verb); found != known.end()) return found->second;
  std::string command = "'";
  command.append(build_dir() / "sigs").append("' ").append(verb).append(" --help");
  const Run finished = run_together(command);
  REQUIRE_MESSAGE(finished.status == 0, finished.out);
  return known[verb] = finished.out;
}

std::set<std::string> matches(const std::string& text, const std::regex& pattern) {
  std::set<std::string> found;
  for (std::sregex_iterator it(text.begin(), text.end(), pattern), end; it != end; ++it) found.insert((*it)[1]);
  return found;
}

std::set<std::string> options_in(const std::string& text) {
  return matches(text, std::regex("(--[a-z][a-z-]*)"));
}

std::set<std::string> verbs_below(const std::string& verb) {
  const std::string help = help_of(verb);
  const std::size_t begin = help.find("Subcommands:");
  if (begin == std::string::npos) return {};
  const std::size_t end = help.find("Examples:");
  return matches(help.substr(begin, end - begin), std::regex("\n  ([a-z-]+) "));
}

// "export", "evaluate", "evaluate track", ...
std::set<std::string> verbs() {
  std::set<std::string> all = verbs_below("");
  for (const std::string& verb : verbs_below(""))
    for (const std::string& part : verbs_below(verb)) all.insert(verb + " " + part);
  return all;
}

// The part of the page below "## sigs VERB".
std::string section(const std::string& verb) {
  const std::string text = page("command-line.md");
  const std::size_t begin = text.find("\n## sigs " + verb + "\n");
  REQUIRE_MESSAGE(begin != std::string::npos, "no section on " << verb);
  return text.substr(begin, text.find("\n## ", begin + 1) - begin);
}

}  // namespace

TEST_CASE("the command line's page has a section on every verb with exactly its options") {
  REQUIRE(verbs().size() >= 6);
  REQUIRE(verbs().contains("evaluate track"));
  for (const std::string& verb : verbs()) {
    std::set<std::string> on_page;
    for (const auto& row : table_rows(section(verb), "| option | default | meaning |"))
      on_page.merge(options_in(row.front()));
    std::set<std::string> in_program = options_in(help_of(verb).substr(0, help_of(verb).find("Examples:")));
    in_program.erase("--help");
    for (const std::string& option : in_program) CHECK_MESSAGE(on_page.contains(option), verb << " " << option);
    for (const std::string& option : on_page) CHECK_MESSAGE(in_program.contains(option), verb << " " << option);
  }
}

TEST_CASE("the command line's page has every layout of results that --format takes") {
  const std::string help = help_of("evaluate track");
  const std::set<std::string> in_program =
      matches(help.substr(help.find("of the results: ")), std::regex("^of the results:([^-]*)"));
  REQUIRE(in_program.size() == 1);
  std::string on_page;
  for (const auto& row : table_rows(section("evaluate track"), "| option | default | meaning |"))
    if (row.front().starts_with("--format")) on_page = row.back();
  const std::set<std::string> layouts = matches(*in_program.begin(), std::regex("([a-z]+)"));
  CHECK(layouts.size() >= 7);
  for (const std::string& layout : layouts)
    CHECK_MESSAGE(on_page.find(layout) != std::string::npos, "--format " << layout << ": " << on_page);
}

TEST_CASE("the command line's page has the exit statuses that the program names") {
  const std::string help = help_of("");
  const std::set<std::string> in_program =
      matches(help.substr(help.find("Exit status:")), std::regex("[:,]\\s+([0-9]+) "));
  REQUIRE(in_program.size() >= 9);
  std::set<std::string> on_page;
  for (const auto& row : table_rows(page("command-line.md"), "| status | meaning |")) on_page.insert(row.front());
  CHECK(on_page == in_program);
}

}  // namespace sigs::test

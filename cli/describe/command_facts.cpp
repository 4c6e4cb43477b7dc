// SPDX-License-Identifier: MIT
#include "cli/describe/command_facts.h"

#include <algorithm>
#include <sstream>
#include <string_view>

#include "base/text.h"

namespace sigs::cli {

namespace {

bool is_word(const std::string& text) {
  return !text.empty() && std::ranges::all_of(text, [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '-' || c == '_';
  });
}

std::vector<std::string> parts_of(const std::string& text, std::string_view separators) {
  std::vector<std::string> parts(1);
  for (const char c : text) {
    if (separators.find(c) != std::string_view::npos)
      parts.emplace_back();
    else
      parts.back() += c;
  }
  return parts;
}

// "a, b or c" -> a, b, c; empty where any of them is not a single word.
std::vector<std::string> words_of(std::string list) {
  for (std::size_t place = list.find(" or "); place != std::string::npos; place = list.find(" or "))
    list.replace(place, 4, ", ");
  std::vector<std::string> words;
  for (const std::string& part : parts_of(list, ",")) {
    words.emplace_back(trimmed(part));
    if (!is_word(words.back())) return {};
  }
  return words;
}

bool is_one_of(const std::string& word, std::initializer_list<std::string_view> words) {
  return std::ranges::find(words, word) != words.end();
}

// By the word that stands for the value: "FILE", "FILES|DIRS ...".
ValueKind kind_of(const std::string& value) {
  std::string word = value.substr(0, value.find_first_of(" |=:"));
  if (word.ends_with("S")) word.pop_back();
  if (word.empty()) return ValueKind::none;
  if (word == "DIR") return ValueKind::folder;
  const bool is_file =
      is_one_of(word, {"FILE", "PROJECT", "VIDEO", "RECIPE", "LABEL", "INPUT", "IMAGE", "LOG", "RIG"}) ||
      word.find("PROJECT") != std::string::npos || word.find("LABEL") != std::string::npos;
  return is_file ? ValueKind::file : ValueKind::text;
}

std::vector<std::string> names_of_option(const CLI::Option& option) {
  if (option.get_positional() && !option.nonpositional()) return {option.get_name()};
  std::vector<std::string> names;
  for (const std::string& name : option.get_snames()) names.push_back("-" + name);
  for (const std::string& name : option.get_lnames()) names.push_back("--" + name);
  return names;
}

OptionFacts facts_of_option(const CLI::Option& option) {
  OptionFacts facts{.names = names_of_option(option), .help = option.get_description()};
  facts.is_required = option.get_required();
  if (option.get_positional() && !option.nonpositional()) {
    facts.value = option.get_option_text().empty() ? option.get_name() : option.get_option_text();
    facts.kind = kind_of(facts.names.front());
    if (facts.kind == ValueKind::text) facts.kind = ValueKind::file;  // all that `sigs` takes
    return facts;
  }
  if (option.get_type_size() == 0) return facts;  // a flag
  facts.value = option.get_option_text();
  const std::string type = option.get_type_name();
  if (facts.value.empty()) facts.value = type == "TEXT" ? "FILE" : type.starts_with("INT") ? "N" : type;
  // CLI11 repeats the default in the text where there is one: NAME=auto.
  facts.default_text = option.get_default_str();
  if (const std::size_t equals = facts.value.find('='); equals != std::string::npos && facts.value.find("KEY") != 0) {
    facts.default_text = facts.value.substr(equals + 1);
    facts.value.resize(equals);
  }
  facts.kind = kind_of(facts.value);
  if (is_one_of(facts.value.substr(0, facts.value.find(' ')), {"NAME", "NAMES", "STYLE"})) {
    facts.choices = listed_words(facts.help);
    facts.takes_list = facts.value.starts_with("NAMES");
  }
  return facts;
}

// "Examples:" and "Exit status:" of the text below the options.
void read_footer(const std::string& footer, CommandFacts& facts) {
  std::istringstream lines(footer);
  std::string line;
  bool are_examples = false;
  std::string paragraph;
  const auto finish = [&] {
    constexpr std::string_view kStatus = "Exit status: ";
    if (paragraph.starts_with(kStatus))
      facts.exit_status = paragraph.substr(kStatus.size());
    else if (!paragraph.empty())
      facts.notes.push_back(paragraph);
    paragraph.clear();
  };
  while (std::getline(lines, line)) {
    if (line.empty()) {
      are_examples = false;
      finish();
    } else if (line == "Examples:" || line == "Example:") {
      are_examples = true;
    } else if (are_examples) {
      facts.examples.emplace_back(trimmed(line));
    } else {
      paragraph += (paragraph.empty() ? "" : " ") + std::string(trimmed(line));
    }
  }
  finish();
}

CommandFacts facts_of_command(const CLI::App& command, const std::string& name, const std::string& footer_above) {
  CommandFacts facts{.name = name, .summary = command.get_description()};
  for (const CLI::Option* const option : command.get_options()) {
    OptionFacts one = facts_of_option(*option);
    (option->get_positional() && !option->nonpositional() ? facts.positionals : facts.options).push_back(one);
  }
  read_footer(command.get_footer(), facts);
  // A subcommand without its own text has that of the program.
  if (command.get_footer() == footer_above)
    std::erase_if(facts.examples, [&](const std::string& line) { return !line.starts_with(name + " "); });
  for (const CLI::App* const below : command.get_subcommands([](const CLI::App*) { return true; }))
    facts.commands.push_back(facts_of_command(*below, name + " " + below->get_name(), command.get_footer()));
  return facts;
}

}  // namespace

std::vector<std::string> listed_words(const std::string& help) {
  std::vector<std::string> words;
  for (const std::string& part : parts_of(help, ":;")) {
    std::vector<std::string> found = words_of(std::string(trimmed(part)));
    const bool is_list = found.size() > 1;
    if (words.empty() && !is_list) continue;
    if (!words.empty() && found.size() != 1) break;
    words.insert(words.end(), found.begin(), found.end());
  }
  return words;
}

CommandFacts facts_of(const CLI::App& program) {
  return facts_of_command(program, program.get_name(), "");
}

}  // namespace sigs::cli

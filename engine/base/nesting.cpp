// SPDX-License-Identifier: MIT
#include "base/nesting.h"

#include <algorithm>
#include <cstddef>
#include <vector>

namespace sigs {

namespace {

// Follows the rules of OpenCV 4's parser (modules/core/src/persistence_yml.cpp): quotes and brackets have a meaning
// only where a value begins, a key is everything before a colon, and strings end with their line.
class OpencvYaml {
 public:
  explicit OpencvYaml(std::string_view text) : text_(text) {}

  [[nodiscard]] int depth() {
    while (at_ < text_.size() && !is_wrong_) {
      skip_blanks();
      if (is_line_end()) {
        next_line();
      } else if (brackets_.empty()) {
        read_block_token();
      } else {
        read_flow_token();
      }
    }
    return deepest_;
  }

 private:
  enum class Expected { first, key, value, separator };

  [[nodiscard]] char here() const { return at_ < text_.size() ? text_[at_] : '\n'; }
  [[nodiscard]] bool is_line_end() const { return here() == '\n' || here() == '#'; }
  void skip_blanks() {
    while (here() == ' ' || here() == '\t' || here() == '\r') ++at_;
  }
  void skip_until(std::string_view ends) { at_ = std::min(text_.find_first_of(ends, at_), text_.size()); }
  void next_line() {
    skip_until("\n");
    line_begin_ = ++at_;
    is_key_ = true;
  }

  void note_depth() {
    deepest_ = std::max(deepest_, static_cast<int>(columns_.size()) + static_cast<int>(brackets_.size()));
  }

  // A block list or map that begins in a column contains those that begin further right.
  void enter_column() {
    const std::size_t column = at_ - line_begin_;
    while (!columns_.empty() && columns_.back() > column) columns_.pop_back();
    if (columns_.empty() || columns_.back() < column) columns_.push_back(column);
    note_depth();
  }

  void read_block_token() {
    const char c = here();
    enter_column();
    if (c == '[' || c == '{') {
      open();
    } else if (c == '!') {
      skip_until(" \n");
    } else if (c == '-') {
      ++at_;
      is_key_ = false;
    } else if (!is_key_ && (c == '"' || c == '\'')) {
      skip_quoted();
    } else {
      skip_until(":\n");
      is_key_ = false;
      if (here() == ':') ++at_;
    }
  }

  void read_flow_token() {
    const char c = here();
    const bool can_close = expected_ != Expected::key;  // after a comma a map's key may begin with a bracket
    if (can_close && (c == ']' || c == '}')) {
      close();
    } else if (expected_ == Expected::separator) {
      is_wrong_ = c != ',';
      expect_element();
      ++at_;
    } else if (expected_ == Expected::first) {
      expect_element();
    } else if (expected_ == Expected::key) {
      skip_until(":\n");
      is_wrong_ = here() != ':';
      expected_ = Expected::value;
      ++at_;
    } else {
      read_flow_value();
    }
  }

  void read_flow_value() {
    const char c = here();
    if (c == '[' || c == '{') {
      open();
    } else if (c == '!') {
      skip_until(" \n");
    } else {
      if (c == '"' || c == '\'')
        skip_quoted();
      else
        skip_until(",]}\n");
      expected_ = Expected::separator;
    }
  }

  void expect_element() { expected_ = brackets_.back() == '{' ? Expected::key : Expected::value; }

  void open() {
    brackets_.push_back(here());
    note_depth();
    expected_ = Expected::first;
    ++at_;
  }

  void close() {
    is_wrong_ = brackets_.back() != (here() == ']' ? '[' : '{');
    brackets_.pop_back();
    expected_ = Expected::separator;
    is_key_ = true;  // what follows in this line can only be the next key
    ++at_;
  }

  // To behind the closing quote, or to the end of the line where there is none. \" and '' stand for the quote itself.
  void skip_quoted() {
    const char quote = here();
    for (++at_; here() != '\n'; ++at_) {
      const bool is_doubled = quote == '\'' && text_.substr(at_, 2) == "''";
      const bool is_escape = quote == '"' && here() == '\\' && text_.substr(at_, 2) != "\\\n";
      if (is_doubled || is_escape) {
        ++at_;
      } else if (here() == quote) {
        ++at_;
        return;
      }
    }
  }

  std::string_view text_;
  std::size_t at_ = 0;
  std::size_t line_begin_ = 0;
  bool is_key_ = true;  // of a block map: quotes mean nothing in it
  bool is_wrong_ = false;
  Expected expected_ = Expected::value;
  std::vector<std::size_t> columns_;
  std::vector<char> brackets_;
  int deepest_ = 0;
};

}  // namespace

int json_depth(std::string_view text) {
  int depth = 0;
  int deepest = 0;
  bool is_quoted = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (c == '"') is_quoted = !is_quoted;
    if (is_quoted && c == '\\') ++i;
    if (is_quoted) continue;
    if (c == '[' || c == '{') deepest = std::max(deepest, ++depth);
    if (c == ']' || c == '}') --depth;
  }
  return deepest;
}

int xml_depth(std::string_view text) {
  int depth = 0;
  int deepest = 0;
  for (std::size_t at = text.find('<'); at != std::string_view::npos; at = text.find('<', at)) {
    const std::string_view tag = text.substr(at);
    const bool is_comment = tag.starts_with("<!--");
    const std::size_t end = is_comment ? tag.find("-->", 4) : tag.find('>');
    const bool is_element = !tag.starts_with("<!") && !tag.starts_with("<?") && !tag.starts_with("</");
    if (tag.starts_with("</")) --depth;
    if (is_element) deepest = std::max(deepest, ++depth);
    if (end == std::string_view::npos) break;
    if (is_element && tag[end - 1] == '/') --depth;
    at += end;
  }
  return deepest;
}

int opencv_yaml_depth(std::string_view text) {
  return OpencvYaml(text).depth();
}

}  // namespace sigs

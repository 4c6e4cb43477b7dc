// SPDX-License-Identifier: MIT
#include "camera/plain_yaml.h"

#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/yaml.h>

#include <exception>
#include <sstream>
#include <utility>

#include "base/nesting.h"

namespace sigs::calibration {
namespace {

void append(const YAML::Node& node, Field& field) {
  double number = 0;
  if (node.IsScalar() && YAML::convert<double>::decode(node, number)) {
    field.numbers.push_back(number);
  } else if (node.IsSequence()) {
    for (const YAML::Node& element : node) append(element, field);
  } else if (!field.not_a_number) {
    field.not_a_number = node.IsScalar() ? node.Scalar() : "?";
  }
}

Field field_of(std::string name, const YAML::Node& node) {
  Field field{.name = std::move(name)};
  if (node.IsScalar()) field.text = node.Scalar();
  if (!node.IsMap()) {
    append(node, field);
    return field;
  }
  const YAML::Node rows = node["rows"];
  const YAML::Node cols = node["cols"];
  std::size_t row_count = 0;
  std::size_t col_count = 0;
  if (rows && cols && YAML::convert<std::size_t>::decode(rows, row_count) &&
      YAML::convert<std::size_t>::decode(cols, col_count))
    field.stated_count = row_count * col_count;
  if (const YAML::Node data = node["data"]) append(data, field);
  return field;
}

// Told of one element after the other, before nodes are made of them: stops at what nodes cannot safely be made of.
// Nodes that hold themselves have no end, and aliases of aliases grow without bound.
class Guard : public YAML::EventHandler {
 public:
  explicit Guard(const std::string& file_name) : file_name_(file_name) {}

  void OnDocumentStart(const YAML::Mark&) override {}
  void OnDocumentEnd() override {}
  void OnNull(const YAML::Mark&, YAML::anchor_t) override {}
  void OnScalar(const YAML::Mark&, const std::string&, YAML::anchor_t, const std::string&) override {}
  void OnAlias(const YAML::Mark& mark, YAML::anchor_t) override {
    throw YAML::ParserException(mark, "an alias (*name) is not read; write the value itself");
  }
  void OnSequenceStart(const YAML::Mark& mark, const std::string&, YAML::anchor_t, YAML::EmitterStyle::value) override {
    enter(mark);
  }
  void OnSequenceEnd() override { --depth_; }
  void OnMapStart(const YAML::Mark& mark, const std::string&, YAML::anchor_t, YAML::EmitterStyle::value) override {
    enter(mark);
  }
  void OnMapEnd() override { --depth_; }

 private:
  void enter(const YAML::Mark& mark) {
    if (++depth_ > kMaxNesting) throw YAML::ParserException(mark, too_deep(file_name_).what);
  }

  const std::string& file_name_;
  int depth_ = 0;
};

}  // namespace

Result<Fields> plain_yaml_fields(const std::string& text, const std::string& file_name) {
  try {
    Guard guard(file_name);
    std::istringstream stream(text);
    YAML::Parser(stream).HandleNextDocument(guard);
    const YAML::Node root = YAML::Load(text);
    if (!root.IsMap()) return fail(file_name, "not a calibration: expected XML, or YAML or JSON with keys");
    Fields fields;
    for (const auto& entry : root) {
      if (!entry.first.IsScalar()) continue;
      Field field = field_of(entry.first.Scalar(), entry.second);
      fields.emplace(entry.first.Scalar(), std::move(field));
    }
    return fields;
  } catch (const YAML::Exception& error) {
    return fail(file_name, "line " + std::to_string(error.mark.line + 1) + ": " + error.msg);
  } catch (const std::exception& error) {
    return fail(file_name, std::string("not readable as YAML: ") + error.what());
  }
}

}  // namespace sigs::calibration

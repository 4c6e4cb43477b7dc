// SPDX-License-Identifier: MIT
#include "camera/opencv_storage.h"

#include <algorithm>
#include <cctype>
#include <exception>
#include <opencv2/core.hpp>
#include <string_view>
#include <utility>

#include "base/nesting.h"
#include "base/text.h"

namespace sigs::calibration {
namespace {

void append(const cv::FileNode& node, Field& field) {
  if (node.isInt() || node.isReal()) {
    field.numbers.push_back(node.real());
  } else if (node.isSeq()) {
    for (const cv::FileNode& element : node) append(element, field);
  } else if (!field.not_a_number) {
    field.not_a_number = node.isString() ? node.string() : "?";
  }
}

Field field_of(const cv::FileNode& node) {
  Field field{.name = node.name()};
  if (node.isString()) field.text = node.string();
  if (!node.isMap()) {
    append(node, field);
    return field;
  }
  const cv::FileNode rows = node["rows"];
  const cv::FileNode cols = node["cols"];
  if (rows.isInt() && cols.isInt() && rows.real() >= 0 && cols.real() >= 0)
    field.stated_count = static_cast<std::size_t>(rows.real() * cols.real());
  const cv::FileNode data = node["data"];
  if (!data.empty()) append(data, field);
  return field;
}

Fields fields_of(const cv::FileNode& root) {
  Fields fields;
  if (!root.isMap()) return fields;
  for (const cv::FileNode& node : root) {
    Field field = field_of(node);
    fields.emplace(field.name, std::move(field));
  }
  return fields;
}

// The message proper, on one line.
std::string reason(const cv::Exception& error) {
  std::string text = error.err.empty() ? std::string("syntax error") : error.err;
  std::ranges::replace(text, '\n', ' ');
  return text;
}

// YAML up to the end of its first document; a calibration is nothing else.
std::string first_document(const std::string& text) {
  const std::size_t end = text.find("\n...");
  return end == std::string::npos ? text : text.substr(0, end + 1);
}

// Of the first line that is neither empty nor a comment, a directive or the document's beginning.
std::string_view first_line(std::string_view text) {
  while (!text.empty()) {
    const std::string_view line = next_line(text);
    if (!line.empty() && line.front() != '%' && line.front() != '#' && trimmed(line) != "---" && !trimmed(line).empty())
      return line;
  }
  return {};
}

bool begins_with_key(std::string_view line) {
  return !line.empty() && (std::isalnum(static_cast<unsigned char>(line.front())) != 0 || line.front() == '_');
}

}  // namespace

Result<Fields> opencv_storage_fields(const std::string& text, const std::string& file_name) {
  const bool is_xml = text.starts_with('<');
  const int depth = is_xml ? xml_depth(text) : opencv_yaml_depth(text);
  if (depth > kMaxNesting) return fail(too_deep(file_name));  // the storage calls itself for each level
  // With anything else the storage of OpenCV 4.6 may never come back.
  if (!is_xml && !begins_with_key(first_line(text)))
    return fail(file_name, "not a calibration: expected keys at the beginning of its lines");
  try {
    const cv::FileStorage storage(is_xml ? text : first_document(text),
                                  cv::FileStorage::READ | cv::FileStorage::MEMORY);
    if (!storage.isOpened()) return fail(file_name, "not an OpenCV calibration file");
    return fields_of(storage.root());
  } catch (const cv::Exception& error) {
    return fail(file_name, "not readable as an OpenCV file: " + reason(error));
  } catch (const std::exception& error) {
    return fail(file_name, std::string("not readable as an OpenCV file: ") + error.what());
  }
}

}  // namespace sigs::calibration

// SPDX-License-Identifier: MIT
#pragma once

#include <pugixml.hpp>
#include <string>

#include "labels/xml_text.h"

namespace sigs {

// Puts <name>text</name> at a node's end.
inline void add_element(pugi::xml_node node, const char* name, const std::string& text) {
  node.append_child(name).text() = xml_text(text).c_str();
}

inline void add_element(pugi::xml_node node, const char* name, int number) {
  add_element(node, name, std::to_string(number));
}

}  // namespace sigs

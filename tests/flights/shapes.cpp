// SPDX-License-Identifier: MIT
#include "flights/shapes.h"

namespace sigs::flights {

Part tail_boom() {
  return {.outlines = {{{0.452, 1.2},
                        {0.468, 0.86},
                        {0.484, 0.52},
                        {0.49, 0.44},
                        {0.51, 0.44},
                        {0.516, 0.52},
                        {0.537, 0.86},
                        {0.558, 1.2}}},
          .color = {168, 172, 176},
          .panel_lines = 5,
          .stripes = {{{0.4, 0.62}, {0.6, 0.62}, {0.6, 0.66}, {0.4, 0.66}}}};
}

Part nose() {
  return {.outlines = {{{0.08, 1.3},
                        {0.16, 0.96},
                        {0.28, 0.74},
                        {0.42, 0.63},
                        {0.53, 0.61},
                        {0.64, 0.65},
                        {0.78, 0.78},
                        {0.88, 0.98},
                        {0.95, 1.3}}},
          .color = {190, 196, 198},
          .panel_lines = 9,
          .stripes = {{{0.47, 0.6}, {0.55, 0.6}, {0.6, 1.2}, {0.42, 1.2}}},
          .stripe_color = {120, 60, 40}};
}

Part wing_tip_left() {
  return {.outlines = {{{-0.2, 0.5},
                        {0.1, 0.55},
                        {0.27, 0.585},
                        {0.335, 0.6},
                        {0.345, 0.63},
                        {0.3, 0.66},
                        {0.12, 0.7},
                        {-0.2, 0.76}}},
          .color = {205, 205, 205},
          .panel_lines = 7,
          .stripes = {{{0.22, 0.5}, {0.27, 0.5}, {0.26, 0.8}, {0.21, 0.8}}},
          .stripe_color = {40, 40, 190}};
}

Part wing_tip_right() {
  return {.outlines =
              {
                  {{1.2, 0.3},
                   {0.86, 0.42},
                   {0.72, 0.47},
                   {0.665, 0.5},
                   {0.67, 0.53},
                   {0.74, 0.53},
                   {0.88, 0.53},
                   {1.2, 0.56}},
              },
          .color = {84, 92, 100},
          .panel_lines = 6,
          .stripes = {{{0.78, 0.4}, {0.81, 0.4}, {0.82, 0.6}, {0.79, 0.6}}},
          .stripe_color = {40, 190, 220}};
}

Part engine_cowl() {
  return {.outlines = {{{0.24, 1.3}, {0.29, 0.92}, {0.37, 0.76}, {0.5, 0.73}, {0.63, 0.76}, {0.71, 0.92}, {0.76, 1.3}}},
          .color = {70, 120, 60},
          .panel_lines = 8};
}

Part spinner() {
  return {.outlines = {{{0.455, 0.78}, {0.462, 0.7}, {0.485, 0.645}, {0.515, 0.645}, {0.538, 0.7}, {0.545, 0.78}}},
          .color = {60, 60, 70},
          .relief = 0.5,
          .panel_lines = 0};
}

Part belly() {
  return {.outlines = {{{0.3, -0.4}, {0.34, 0.02}, {0.42, 0.17}, {0.55, 0.2}, {0.68, 0.14}, {0.75, 0.0}, {0.8, -0.4}}},
          .color = {140, 150, 158},
          .panel_lines = 7};
}

Part strut() {
  return {.outlines = {{{0.36, 0.06}, {0.4, 0.12}, {-0.1, 0.5}, {-0.1, 0.43}}},
          .rounded = false,
          .color = {110, 116, 120},
          .panel_lines = 0};
}

Part windscreen() {
  return {
      .outlines =
          {{{-0.1, -0.1}, {1.1, -0.1}, {1.1, 1.1}, {-0.1, 1.1}},
           {{0.07, 0.16}, {0.2, 0.09}, {0.5, 0.075}, {0.52, 0.08}, {0.5, 0.74}, {0.28, 0.76}, {0.1, 0.81}, {0.05, 0.6}},
           {{0.55, 0.08}, {0.82, 0.1}, {0.93, 0.17}, {0.955, 0.6}, {0.91, 0.82}, {0.75, 0.765}, {0.53, 0.74}}},
      .rounded = false,
      .color = {46, 50, 54},
      .relief = 0.5,
      .panel_lines = 12};
}

Part bonnet() {
  return {
      .outlines =
          {{{-0.2, 1.3}, {-0.2, 0.9}, {0.1, 0.85}, {0.3, 0.82}, {0.55, 0.815}, {0.8, 0.84}, {1.2, 0.92}, {1.2, 1.3}}},
      .color = {176, 170, 168},
      .panel_lines = 4};
}

Part pod() {
  return {.outlines = {{{0.66, -0.3}, {0.67, 0.08}, {0.7, 0.2}, {0.77, 0.24}, {0.85, 0.2}, {0.88, 0.07}, {0.89, -0.3}}},
          .color = {70, 74, 80},
          .relief = 0.4,
          .panel_lines = 3};
}

Part side_float() {
  return {
      .outlines = {{{-0.2, 0.72}, {0.12, 0.74}, {0.26, 0.79}, {0.31, 0.85}, {0.24, 0.9}, {0.05, 0.93}, {-0.2, 0.94}}},
      .color = {210, 206, 196},
      .panel_lines = 5};
}

std::vector<Part> skids() {
  const Part left{.outlines = {{{0.1, 1.2}, {0.17, 0.8}, {0.2, 0.7}, {0.235, 0.69}, {0.23, 0.82}, {0.19, 1.2}}},
                  .color = {96, 96, 100},
                  .panel_lines = 2};
  const Part right{.outlines = {{{0.81, 1.2}, {0.78, 0.83}, {0.775, 0.7}, {0.805, 0.7}, {0.84, 0.8}, {0.9, 1.2}}},
                   .color = {96, 96, 100},
                   .panel_lines = 2};
  return {left, right};
}

Propeller propeller() {
  return {.middle = {0.5, 0.7}, .radius = 0.3, .blades = 3};
}

Part plain(Part part, const cv::Scalar& color) {
  part.color = color;
  part.stripes.clear();
  return part;
}

Part lifted(Part part, double share) {
  for (auto* outlines : {&part.outlines, &part.stripes})
    for (Part::Outline& outline : *outlines)
      for (cv::Point2d& p : outline) p.y -= share;
  return part;
}

}  // namespace sigs::flights

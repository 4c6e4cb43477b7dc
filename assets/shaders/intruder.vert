#version 330 core
// SPDX-License-Identifier: MIT
// Body coordinates to the image. The origin of all lighting is the body's reference point, turned like the view, so
// that the numbers stay small however far away the camera is.

uniform mat4 clip_from_body;
uniform mat3 view_from_body;

// Drawn twice, to find what is visible and to shade it: both times at the same depth.
invariant gl_Position;

layout(location = 0) in vec3 position_m;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec2 uv;
layout(location = 3) in vec4 color;
layout(location = 4) in vec4 gloss;

out vec3 surface_m;
// At rims the middle of the pixel may lie outside the triangle, where a normal could point anywhere. The image on the
// surface wants the very middle: drivers take any covered sample for the centroid, which would shift it.
centroid out vec3 surface_normal;
out vec2 surface_uv;
flat out vec4 surface_color;
flat out vec4 surface_gloss;

void main() {
  gl_Position = clip_from_body * vec4(position_m, 1.0);
  surface_m = view_from_body * position_m;
  surface_normal = view_from_body * normal;
  surface_uv = vec2(uv.x, 1.0 - uv.y);  // the first row of the image is its top
  surface_color = color;
  surface_gloss = gloss;
}

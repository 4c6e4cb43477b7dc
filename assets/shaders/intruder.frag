#version 330 core
// SPDX-License-Identifier: MIT
// Lambert and Blinn-Phong (Blinn 1977) in linear light; the result is premultiplied.

uniform vec3 diffuse;  // linear
uniform vec3 specular;
uniform float shininess;
uniform float opacity;
uniform sampler2D picture;  // premultiplied; decoded from sRGB by the sampler

// Fragments whose opacity lies outside [lowest, highest) belong to another pass. solid: the picture's opacity is to be
// ignored, because this surface touches only its opaque texels.
uniform float lowest_opacity;
uniform float highest_opacity;
uniform bool solid;

uniform vec3 light_color;
uniform float ambient;
// A point p that may be far away is given as p * scale, with scale so small that squares fit a float.
uniform vec3 light_scaled;
uniform float light_scale;
uniform vec3 eye_scaled;
uniform float eye_scale;

in vec3 surface_m;
centroid in vec3 surface_normal;
in vec2 surface_uv;

layout(location = 0) out vec4 color;
layout(location = 1) out float coverage;

vec3 unit_or(vec3 v, vec3 fallback) {
  float size = length(v);
  return size > 1e-12 ? v / size : fallback;
}

void main() {
  vec4 texel = texture(picture, surface_uv);
  if (solid) texel = vec4(texel.rgb / max(texel.a, 1e-4), 1.0);
  float alpha = texel.a * opacity;
  if (alpha < lowest_opacity || alpha >= highest_opacity) discard;

  vec3 outside = unit_or(surface_normal, vec3(-1.0, 0.0, 0.0));
  vec3 n = gl_FrontFacing ? outside : -outside;
  vec3 to_light = unit_or(light_scaled - surface_m * light_scale, n);
  vec3 to_eye = unit_or(eye_scaled - surface_m * eye_scale, n);
  vec3 between = unit_or(to_light + to_eye, n);

  float facing = max(dot(n, to_light), 0.0);
  float direct = 1.0 - ambient;
  vec3 matt = diffuse * texel.rgb * (ambient + direct * facing);
  // A quarter: MTL writers give aircraft paint a specular colour that would outshine its own.
  float gloss = facing > 0.0 ? 0.25 * direct * pow(max(dot(n, between), 0.0), shininess) : 0.0;
  color = vec4(light_color * opacity * (matt + specular * (gloss * texel.a)), alpha);
  coverage = 1.0;
}

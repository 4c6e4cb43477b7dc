#version 330 core
#extension GL_ARB_gpu_shader5 : enable
// SPDX-License-Identifier: MIT
// Lambert and Blinn-Phong (Blinn 1977) in linear light; the result is premultiplied.

// Compiled three times: without an image; with IMAGE, of which only opaque texels are touched; with IMAGE and
// LAYERED, of which only fragments whose opacity lies within [lowest, highest) belong to the pass.
#ifdef IMAGE
uniform sampler2D image;  // premultiplied; decoded from sRGB by the sampler
#endif
#ifdef LAYERED
uniform float lowest_opacity;
uniform float highest_opacity;
#endif

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
flat in vec4 surface_color;  // linear diffuse, opacity
flat in vec4 surface_gloss;  // specular, shininess

layout(location = 0) out vec4 color;
layout(location = 1) out float coverage;

vec3 unit_or(vec3 v, vec3 fallback) {
  float size = length(v);
  return size > 1e-12 ? v / size : fallback;
}

#ifdef IMAGE
// Anisotropic filtering: up to 16 trilinear taps along the longer axis of the pixel's footprint. Written out, because
// software drivers walk every texel of a footprint, and one at a grazing angle then takes seconds.
vec4 filtered(vec2 uv) {
  vec2 size = vec2(textureSize(image, 0));
  vec2 across = dFdx(uv) * size;
  vec2 down = dFdy(uv) * size;
  bool wide = dot(across, across) > dot(down, down);
  vec2 axis = wide ? across : down;
  float longer = length(axis);
  float shorter = length(wide ? down : across);
  // Edge on, uv can be no number at all; the last level is a single texel.
  if (!(longer < 1e5)) return textureLod(image, vec2(0.5), 100.0);
  float taps = clamp(ceil(longer / max(shorter, 1.0)), 1.0, 16.0);
#ifdef GL_ARB_gpu_shader5
  // Software drivers shade whole blocks of pixels, of which a small triangle covers few. The rest needs no taps.
  if (gl_SampleMaskIn[0] == 0) taps = 0.0;
#endif
  float level = log2(max(longer / max(taps, 1.0), 1.0));
  vec4 sum = vec4(0.0);
  for (float i = 0.5; i < taps; i += 1.0) sum += textureLod(image, uv + axis / size * (i / taps - 0.5), level);
  return sum / max(taps, 1.0);
}
#endif

void main() {
#ifdef IMAGE
  vec4 texel = filtered(surface_uv);
#ifndef LAYERED
  texel = vec4(texel.rgb / max(texel.a, 1e-4), 1.0);
#endif
#else
  vec4 texel = vec4(1.0);
#endif
  float opacity = surface_color.a;
  float alpha = texel.a * opacity;
#ifdef LAYERED
  if (alpha < lowest_opacity || alpha >= highest_opacity) discard;
#endif

  vec3 outside = unit_or(surface_normal, vec3(-1.0, 0.0, 0.0));
  vec3 n = gl_FrontFacing ? outside : -outside;
  vec3 to_light = unit_or(light_scaled - surface_m * light_scale, n);
  vec3 to_eye = unit_or(eye_scaled - surface_m * eye_scale, n);
  vec3 between = unit_or(to_light + to_eye, n);

  float facing = max(dot(n, to_light), 0.0);
  float direct = 1.0 - ambient;
  vec3 matt = surface_color.rgb * texel.rgb * (ambient + direct * facing);
  // A quarter: MTL writers give aircraft paint a specular colour that would outshine its own.
  float gloss = facing > 0.0 ? 0.25 * direct * pow(max(dot(n, between), 0.0), surface_gloss.a) : 0.0;
  color = vec4(light_color * opacity * (matt + surface_gloss.rgb * (gloss * texel.a)), alpha);
  coverage = 1.0;
}

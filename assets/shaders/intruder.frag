#version 330 core
#extension GL_ARB_gpu_shader5 : enable
// SPDX-License-Identifier: MIT
// Lambert and Blinn-Phong (Blinn 1977) in linear light; the result is premultiplied.

// Compiled for each kind of surface: without an image; with IMAGE, of which only opaque texels are touched; with IMAGE
// and LAYERED, of which only fragments whose opacity lies within [lowest, highest) belong to the pass. Each is compiled
// With ROTOR the surface is the disc of turning blades, without an image. Each is compiled
// for the point light and, with SUN, for sun, sky and ground. DEPTH draws depth alone, for the map of shadows.
#ifdef IMAGE
uniform sampler2D image;  // premultiplied; decoded from sRGB by the sampler
#endif
#ifdef LAYERED
uniform float lowest_opacity;
uniform float highest_opacity;
#endif

uniform vec3 light_color;
// A point p that may be far away is given as p * scale, with scale so small that squares fit a float.
#ifdef SUN
uniform vec3 to_sun;
uniform vec3 up;
uniform vec3 sky_color;
uniform vec3 ground_color;
uniform sampler2D sun_depth;   // of what the sun's light meets first: 0..1 of sun_depth_range
uniform float sun_depth_range; // texels
uniform mat4 texels_from_surface;  // x, y in the map, and depth away from the sun, in texels
#else
uniform float ambient;
uniform vec3 light_scaled;
uniform float light_scale;
#endif
uniform vec3 eye_scaled;
uniform float eye_scale;

#ifdef ROTOR
// The disc's axes: x to where phases count from, z the axis of turning. Angles in radians, counter-clockwise.
uniform mat3 disc_from_surface;
uniform vec3 hub_in_disc_m;
uniform vec3 blade_radii_m;   // root, tip
uniform vec3 blade_chords_m;  // at root and tip
uniform float blade_apart;    // from blade to blade
uniform float blade_sweep;    // what a blade turns by while the shutter is open
uniform vec3 blade_phase;     // of a blade in the middle of that time: z at the window's origin; x, y more for each pixel
#endif

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

#ifdef SUN
// Share of the sun's light that reaches the surface, 0..1: percentage-closer filtering (Reeves et al. 1987) over the
// four nearest texels, each compared with the plane of the triangle at the middle of that texel. A plane so does not
// shadow itself however flat the light falls in.
//   facet  unit normal of the triangle, towards the eye
float lit_share(vec3 facet) {
  vec3 texel = (texels_from_surface * vec4(surface_m, 1.0)).xyz;
  vec3 normal = mat3(texels_from_surface) * facet;
  float size = length(normal);
  if (!(abs(normal.z) > 1e-3 * size)) return 0.0;  // edge on
  vec2 slope = clamp(-normal.xy / normal.z, -100.0, 100.0);
  float bias = 0.5 + 0.05 * (abs(slope.x) + abs(slope.y));
  vec2 corner = floor(texel.xy - 0.5);
  vec2 share = texel.xy - 0.5 - corner;
  ivec2 last = textureSize(sun_depth, 0) - 1;
  vec4 lit;
  for (int i = 0; i < 4; ++i) {
    vec2 at = corner + vec2(i & 1, i >> 1);
    float plane = texel.z + dot(slope, at + 0.5 - texel.xy);
    float nearest = texelFetch(sun_depth, clamp(ivec2(at), ivec2(0), last), 0).r * sun_depth_range;
    lit[i] = nearest >= plane - bias ? 1.0 : 0.0;
  }
  return mix(mix(lit.x, lit.y, share.x), mix(lit.z, lit.w, share.x), share.y);
}

// Schlick (1994): from `straight`, where the light comes squarely, to 1 at a grazing angle. What hardly reflects at all
// does not do so at grazing angles either (Lagarde and de Rousiers 2014).
vec3 reflected_share(vec3 straight, float cosine) {
  float most = min(50.0 * max(max(straight.r, straight.g), straight.b), 1.0);
  float rest = 1.0 - clamp(cosine, 0.0, 1.0);
  float squared = rest * rest;
  return straight + (most - straight) * (squared * squared * rest);
}

// Of sky and ground, from a direction; at the horizon they pass into each other.
vec3 surroundings(vec3 direction) {
  return mix(ground_color, sky_color, smoothstep(-0.1, 0.1, dot(direction, up)));
}

// Premultiplied colour and opacity. docs/formulas.md has the formulas.
vec4 sunlit(vec4 texel, float opacity, vec3 n, vec3 to_eye, float lit) {
  bool is_glass = opacity < 1.0;
  vec3 straight = 0.25 * surface_gloss.rgb;
  if (is_glass) straight = min(straight, 0.04);  // refractive index 1.5: ((1.5 - 1) / (1.5 + 1))^2
  vec3 between = unit_or(to_sun + to_eye, n);
  float facing = lit * max(dot(n, to_sun), 0.0);
  vec3 hemisphere = mix(ground_color, sky_color, 0.5 + 0.5 * dot(n, up));
  vec3 matt = surface_color.rgb * texel.rgb * (hemisphere + light_color * (1.0 - straight) * facing);
  float shininess = surface_gloss.a;
  float lobe = (shininess + 8.0) / 8.0 * pow(max(dot(n, between), 0.0), shininess);
  vec3 highlight = light_color * facing * lobe * reflected_share(straight, dot(to_sun, between));
  float mirror = is_glass ? dot(reflected_share(straight, dot(n, to_eye)), vec3(1.0 / 3.0)) : 0.0;
  vec3 light = (1.0 - mirror) * opacity * matt + texel.a * (highlight + mirror * surroundings(reflect(-to_eye, n)));
  return vec4(light, texel.a * (opacity + mirror * (1.0 - opacity)));
}
#endif

#ifdef ROTOR
// Share of the exposure in which a blade of width `width`, which sweeps over `sweep`, is before a place at `angle` from
// the middle of the sweep.
float passing(float angle, float width, float sweep) {
  float low = max(angle - 0.5 * width, -0.5 * sweep);
  float high = min(angle + 0.5 * width, 0.5 * sweep);
  return max(high - low, 0.0);
}

// Share of the exposure and of the pixel in which there is a blade. What a pixel spans along the circle counts as more
// sweep, which keeps the sum over all places.
float blade_share() {
  vec2 place = (disc_from_surface * surface_m - hub_in_disc_m).xy;
  float radius = max(length(place), 1e-6);
  vec2 outward = place / radius;
  vec2 around = vec2(-outward.y, outward.x);
  vec2 right = dFdx(place);
  vec2 down = dFdy(place);
  float pixel_outward = max(length(vec2(dot(right, outward), dot(down, outward))), 1e-9);
  float pixel_around = length(vec2(dot(right, around), dot(down, around)));
  float along = clamp((radius - blade_radii_m.x) / (blade_radii_m.y - blade_radii_m.x), 0.0, 1.0);
  float width = min(mix(blade_chords_m.x, blade_chords_m.y, along) / radius, blade_apart);
  float sweep = max(length(vec2(blade_sweep, pixel_around / radius)), 1e-6);
  float passes = floor(sweep / blade_apart);
  float rest = sweep - passes * blade_apart;
  float phase = blade_phase.z + dot(blade_phase.xy, gl_FragCoord.xy) + 0.5 * passes * blade_apart;
  float angle = atan(place.y, place.x) - phase;
  angle -= blade_apart * floor(angle / blade_apart + 0.5);
  float sum = passes * width;
  for (float k = -1.0; k <= 1.0; k += 1.0) sum += passing(angle + k * blade_apart, width, rest);
  float ends = clamp((blade_radii_m.y - radius) / pixel_outward + 0.5, 0.0, 1.0) *
               clamp((radius - blade_radii_m.x) / pixel_outward + 0.5, 0.0, 1.0);
  return clamp(ends * sum / sweep, 0.0, 1.0);
}
#endif

#ifdef DEPTH
void main() {
#ifdef IMAGE
  if (texture(image, surface_uv).a < 0.5) discard;
#endif
}
#else
void main() {
#ifdef IMAGE
  vec4 texel = filtered(surface_uv);
#ifndef LAYERED
  texel = vec4(texel.rgb / max(texel.a, 1e-4), 1.0);
#endif
#else
  vec4 texel = vec4(1.0);
#endif
#ifdef ROTOR
  float opacity = blade_share();
  if (opacity < 1.0 / 255.0) discard;
#else
  float opacity = surface_color.a;
#endif
  float alpha = texel.a * opacity;
#ifdef LAYERED
  if (alpha < lowest_opacity || alpha >= highest_opacity) discard;
#endif

  vec3 outside = unit_or(surface_normal, vec3(-1.0, 0.0, 0.0));
  vec3 n = gl_FrontFacing ? outside : -outside;
#ifdef SUN
  vec3 facet = unit_or(-cross(dFdx(surface_m), dFdy(surface_m)), n);
  if (dot(n, facet) < 0.0) n = -n;
  vec3 to_eye = unit_or(eye_scaled - surface_m * eye_scale, n);
  float lit = dot(facet, to_sun) > 0.0 && dot(n, to_sun) > 0.0 ? lit_share(facet) : 0.0;
  color = sunlit(texel, opacity, n, to_eye, lit);
#else
  vec3 to_light = unit_or(light_scaled - surface_m * light_scale, n);
  vec3 to_eye = unit_or(eye_scaled - surface_m * eye_scale, n);
  vec3 between = unit_or(to_light + to_eye, n);

  float facing = max(dot(n, to_light), 0.0);
  float direct = 1.0 - ambient;
  vec3 matt = surface_color.rgb * texel.rgb * (ambient + direct * facing);
  // A quarter: MTL writers give aircraft paint a specular colour that would outshine its own.
  float gloss = facing > 0.0 ? 0.25 * direct * pow(max(dot(n, between), 0.0), surface_gloss.a) : 0.0;
  color = vec4(light_color * opacity * (matt + surface_gloss.rgb * (gloss * texel.a)), alpha);
#endif
  coverage = 1.0;
}
#endif

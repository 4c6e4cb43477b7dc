// SPDX-License-Identifier: MIT
#include "frame/composed_frame.h"

#include <utility>

namespace sigs {

namespace {

bool is_same(const Camera& a, const Camera& b) {
  return a.size_px == b.size_px && a.lens.parameters() == b.lens.parameters();
}

}  // namespace

Result<Renderer*> ComposeContext::renderer() {
  if (!renderer_) {
    Result<Renderer> created = Renderer::create(settings_.samples_per_pixel);
    if (!created) return fail(created.error());
    renderer_.emplace(std::move(*created));
  }
  return &*renderer_;
}

const DistortMaps& ComposeContext::maps_of(const Camera& camera) {
  if (!camera_of_maps_ || !is_same(*camera_of_maps_, camera)) {
    maps_ = distort_maps(camera);
    camera_of_maps_ = camera;
  }
  return *maps_;
}

LensTable& ComposeContext::lens_of(const Camera& camera) {
  if (!lens_ || !is_same(lens_->camera(), camera)) lens_.emplace(camera, settings_.lens_tolerance_px);
  return *lens_;
}

const HeatColors& ComposeContext::colors_of(HeatPalette palette) {
  if (!colors_ || colors_->palette() != palette) colors_.emplace(palette);
  return *colors_;
}

void ComposeContext::forget(const Mesh& mesh) {
  if (renderer_) renderer_->forget(mesh);
}

std::string ComposeContext::renderer_description() const {
  return renderer_ ? renderer_->description() : std::string();
}

}  // namespace sigs

// SPDX-License-Identifier: MIT
#include "reference/traced_body.h"

#if __has_include(<embree4/rtcore.h>)
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/ensure.h"
#include "reference/shading.h"

namespace sigs::truth {
namespace {

#if RTC_VERSION_MAJOR >= 4
using QueryContext = RTCRayQueryContext;
#else
using QueryContext = RTCIntersectContext;
#endif

// What belongs to one ray; Embree hands its first member back to the filter.
struct Query {
  QueryContext context;
  std::vector<Crossing>* crossings;
  const std::vector<bool>* is_opaque;
};

// Keeps every crossing, and continues the ray through transparent surfaces.
void keep_crossing(const RTCFilterFunctionNArguments* args) {
  if (args->valid[0] == 0) return;
  const Query& query = *reinterpret_cast<const Query*>(args->context);
  const RTCHit hit = rtcGetHitFromHitN(args->hit, args->N, 0);
  const double u = hit.u;
  const double v = hit.v;
  query.crossings->push_back({hit.primID, RTCRayN_tfar(args->ray, args->N, 0), {1 - u - v, u, v}});
  if (!(*query.is_opaque)[hit.primID]) args->valid[0] = 0;
}

void intersect(RTCScene scene, Query& query, RTCRayHit& ray) {
#if RTC_VERSION_MAJOR >= 4
  rtcInitRayQueryContext(&query.context);
  RTCIntersectArguments arguments;
  rtcInitIntersectArguments(&arguments);
  arguments.context = &query.context;
  rtcIntersect1(scene, &ray, &arguments);
#else
  rtcInitIntersectContext(&query.context);
  rtcIntersect1(scene, &query.context, &ray);
#endif
}

}  // namespace

struct TracedBody::Embree {
  RTCDevice device = nullptr;
  RTCScene scene = nullptr;

  Embree(const Mesh& mesh, const std::vector<Triangle>& triangles) : device(rtcNewDevice("threads=2")) {
    ENSURE(device != nullptr);
    scene = rtcNewScene(device);
    rtcSetSceneFlags(scene, RTC_SCENE_FLAG_ROBUST);
    const RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* const positions = static_cast<float*>(rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 3 * sizeof(float), mesh.vertices.size()));
    for (std::size_t i = 0; i < mesh.vertices.size(); ++i)
      for (int axis = 0; axis < 3; ++axis) positions[3 * i + axis] = mesh.vertices[i].position_m[axis];
    auto* const indices = static_cast<std::uint32_t*>(rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(std::uint32_t), triangles.size()));
    for (std::size_t i = 0; i < triangles.size(); ++i)
      std::copy(std::begin(triangles[i].corners), std::end(triangles[i].corners), indices + 3 * i);
    rtcSetGeometryIntersectFilterFunction(geometry, keep_crossing);
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene, geometry);
    rtcReleaseGeometry(geometry);
    rtcCommitScene(scene);
  }
  ~Embree() {
    rtcReleaseScene(scene);
    rtcReleaseDevice(device);
  }
  Embree(const Embree&) = delete;
  Embree& operator=(const Embree&) = delete;
};

TracedBody::TracedBody(const Mesh& mesh) {
  for (const MeshPart& part : mesh.parts) {
    const bool is_opaque = lets_no_light_through(mesh.materials[static_cast<std::size_t>(part.material)]);
    for (std::uint32_t i = part.first_index; i + 2 < part.first_index + part.index_count; i += 3) {
      triangles_.push_back({{mesh.indices[i], mesh.indices[i + 1], mesh.indices[i + 2]}, part.material});
      is_opaque_.push_back(is_opaque);
      for (const std::uint32_t corner : triangles_.back().corners)
        radius_m_ = std::max(radius_m_, glm::length(glm::dvec3(mesh.vertices[corner].position_m)));
    }
  }
  embree_ = std::make_unique<Embree>(mesh, triangles_);
}

TracedBody::~TracedBody() = default;

void TracedBody::cross(const glm::dvec3& origin_m, const glm::dvec3& direction,
                       std::vector<Crossing>& crossings) const {
  crossings.clear();
  const double to_nearest_m = -glm::dot(origin_m, direction);
  const double reach_m = 1.01 * radius_m_ + 1e-6;
  if (glm::length(origin_m + to_nearest_m * direction) > reach_m || to_nearest_m < -reach_m) return;
  const double start_m = std::max(0.0, to_nearest_m - reach_m);
  const glm::vec3 start(origin_m + start_m * direction);
  Query query{{}, &crossings, &is_opaque_};
  RTCRayHit ray{};
  ray.ray.org_x = start.x, ray.ray.org_y = start.y, ray.ray.org_z = start.z;
  ray.ray.dir_x = float(direction.x), ray.ray.dir_y = float(direction.y), ray.ray.dir_z = float(direction.z);
  ray.ray.tfar = std::numeric_limits<float>::infinity();
  ray.ray.mask = ~0U;
  ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  intersect(embree_->scene, query, ray);
  for (Crossing& crossing : crossings) crossing.t_m += start_m;
  std::sort(crossings.begin(), crossings.end(), [](const Crossing& a, const Crossing& b) {
    return a.t_m != b.t_m ? a.t_m < b.t_m : a.triangle < b.triangle;
  });
}

}  // namespace sigs::truth

#pragma once
/// Embree as a visibility engine: the same samples through the same quads.

#include <array>
#include <vector>

#include <embree3/rtcore.h>
#include <tbb/parallel_for.h>

#include "bench/hider_scene.h"

namespace tessera {

/// How Embree is used; the benchmark takes whichever is fastest for a case.
struct EmbreeVariant {
  RTCBuildQuality quality = RTC_BUILD_QUALITY_MEDIUM;
  bool coherent = false;
  int packet = 8;  ///< 8 or 16 rays
};

/// Builds, traces and forgets. Returns the number of samples that hit something; z, u, v and
/// primitive of every sample are stored, as a renderer would.
class EmbreeFrame {
 public:
  explicit EmbreeFrame(const HiderScene& scene)
      : scene_(scene), device_(rtcNewDevice(nullptr)), hits_(scene.buckets.size()) {
    for (size_t b = 0; b < hits_.size(); ++b)
      for (auto& a : hits_[b].values) a.resize(scene.buckets[b].size() + 16);
  }
  ~EmbreeFrame() { rtcReleaseDevice(device_); }
  EmbreeFrame(const EmbreeFrame&) = delete;
  EmbreeFrame& operator=(const EmbreeFrame&) = delete;

  size_t render(const EmbreeVariant& variant) {
    RTCScene scene = build(variant.quality);
    std::vector<size_t> counts(scene_.buckets.size());
    tbb::parallel_for(size_t(0), counts.size(), [&](size_t b) {
      counts[b] = variant.packet == 16 ? trace<16>(scene, variant, b) : trace<8>(scene, variant, b);
    });
    rtcReleaseScene(scene);
    size_t total = 0;
    for (const size_t c : counts) total += c;
    return total;
  }

 private:
  struct Hits {
    std::array<std::vector<float>, 4> values;  // z, u, v, primitive (as bits)
  };

  /// One geometry of all quads. Embree splits (v0, v1, v2, v3) along v1-v3; with (b, a, c, d) that
  /// is the diagonal a-d.
  RTCScene build(RTCBuildQuality quality) {
    RTCScene scene = rtcNewScene(device_);
    rtcSetSceneBuildQuality(scene, quality);
    RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_QUAD);
    rtcSetGeometryBuildQuality(geometry, quality);
    const int keys = scene_.motion ? 2 : 1;
    const size_t row = HiderScene::grid_size + 1, per_grid = row * row;
    rtcSetGeometryTimeStepCount(geometry, unsigned(keys));
    for (int key = 0; key < keys; ++key) {
      auto* p = static_cast<float*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX,
                                                            unsigned(key), RTC_FORMAT_FLOAT3, 12,
                                                            per_grid * scene_.grids.size()));
      tbb::parallel_for(size_t(0), scene_.grids.size(), [&](size_t g) {
        const Grid& grid = *scene_.grids[g];
        for (size_t i = 0; i < per_grid; ++i)
          for (int axis = 0; axis < 3; ++axis)
            p[(g * per_grid + i) * 3 + size_t(axis)] = grid.P(key, axis)[i];
      });
    }
    auto* index = static_cast<uint32_t*>(rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT4, 16, scene_.micropolygon_count()));
    tbb::parallel_for(size_t(0), scene_.grids.size(), [&](size_t g) {
      constexpr size_t n = HiderScene::grid_size;
      uint32_t* to = index + g * n * n * 4;
      for (size_t j = 0; j < n; ++j)
        for (size_t i = 0; i < n; ++i) {
          const size_t a = g * per_grid + j * row + i;
          for (const size_t v : {a + 1, a, a + row, a + row + 1}) *to++ = uint32_t(v);
        }
    });
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene, geometry);
    rtcReleaseGeometry(geometry);
    rtcCommitScene(scene);
    return scene;
  }

  template <int N>
  struct Packet;

  template <int N>
  size_t trace(RTCScene scene, const EmbreeVariant& variant, size_t b) {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    context.flags = variant.coherent ? RTC_INTERSECT_CONTEXT_FLAG_COHERENT
                                     : RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
    const size_t count = scene_.buckets[b].size();
    size_t hits = 0;
    for (size_t i = 0; i < count; i += N) {
      alignas(64) typename Packet<N>::Type h;
      alignas(64) int valid[N];
      for (int k = 0; k < N; ++k) {
        valid[k] = i + size_t(k) < count ? -1 : 0;
        set_ray(scene_.buckets[b], std::min(i + size_t(k), count - 1), h.ray, k);
        h.hit.geomID[k] = RTC_INVALID_GEOMETRY_ID;
      }
      Packet<N>::intersect(valid, scene, &context, &h);
      auto& [z, u, v, primitive] = hits_[b].values;
      for (int k = 0; k < N; ++k) {
        z[i + size_t(k)] = h.ray.tfar[k], u[i + size_t(k)] = h.hit.u[k],
              v[i + size_t(k)] = h.hit.v[k];
        primitive[i + size_t(k)] = std::bit_cast<float>(h.hit.primID[k]);
        hits += valid[k] && h.hit.geomID[k] != RTC_INVALID_GEOMETRY_ID;
      }
    }
    return hits;
  }

  /// Camera::ray_camera in float, for the perspective camera of the scene.
  template <class Ray>
  void set_ray(const SampleBlock& s, size_t i, Ray& ray, int k) const {
    const RasterClipMap& m = scene_.camera.raster_clip();
    const float u = scene_.lens ? s.u[i] : 0.0f, v = scene_.lens ? s.v[i] : 0.0f;
    // X = x_scale x' + (x_from_w + u scale) z + u offset: the sight line of raster x.
    ray.org_x[k] = -u * m.coc_x.offset / m.x_scale, ray.org_y[k] = -v * m.coc_y.offset / m.y_scale;
    ray.org_z[k] = 0;
    ray.dir_x[k] = (s.x[i] - m.x_from_w - u * m.coc_x.scale) / m.x_scale;
    ray.dir_y[k] = (s.y[i] - m.y_from_w - v * m.coc_y.scale) / m.y_scale;
    ray.dir_z[k] = 1;
    ray.tnear[k] = scene_.camera.near_clip(), ray.tfar[k] = 1e30f;
    ray.time[k] = scene_.motion ? s.t[i] : 0.0f;
    ray.mask[k] = ~0u, ray.flags[k] = 0, ray.id[k] = 0;
  }

  const HiderScene& scene_;
  RTCDevice device_;
  std::vector<Hits> hits_;
};

template <>
struct EmbreeFrame::Packet<8> {
  using Type = RTCRayHit8;
  static constexpr auto intersect = rtcIntersect8;
};
template <>
struct EmbreeFrame::Packet<16> {
  using Type = RTCRayHit16;
  static constexpr auto intersect = rtcIntersect16;
};

}  // namespace tessera

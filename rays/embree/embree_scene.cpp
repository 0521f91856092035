#include "rays/embree/embree_scene.h"

#include <algorithm>
#include <cmath>
#include <map>

#include <tbb/task_arena.h>

#include "base/error.h"
#include "shade/fragment_geometry.h"

namespace tessera {

namespace {

/// A geometry until it is handed over, or something fails before.
struct ReleaseGeometry {
  void operator()(RTCGeometry geometry) const { rtcReleaseGeometry(geometry); }
};
using OwnGeometry = std::unique_ptr<std::remove_pointer_t<RTCGeometry>, ReleaseGeometry>;

constexpr int most_intervals = 64;
constexpr float key_tolerance = 1e-4f;

size_t triangle_count(std::span<const uint32_t> grids, const auto& all) {
  size_t count = 0;
  for (uint32_t g : grids) count += 2 * size_t(all[g]->micropolygon_count());
  return count;
}

size_t vertex_count(std::span<const uint32_t> grids, const auto& all) {
  size_t count = 0;
  for (uint32_t g : grids) count += size_t(all[g]->vertex_count());
  return count;
}

/// The power of two that brings the largest coordinate into [1, 2). What is beyond 1e15 does not
/// count, or the rest would vanish beside it.
float scale_of(std::span<const std::shared_ptr<const Grid>> grids) {
  float most = 0;
  for (const auto& grid : grids) {
    for (int key = 0; key < grid->key_count(); ++key) {
      for (int axis = 0; axis < 3; ++axis) {
        const float* P = grid->P(key, axis);
        for (int k = 0; k < grid->vertex_count(); ++k) {
          const float size = std::abs(P[k]);
          if (size < 1e15f) most = std::max(most, size);
        }
      }
    }
  }
  return most > 0 ? std::ldexp(1.0f, -std::max(std::ilogb(most), -100)) : 1.0f;
}

/// Vertices of a grid between two keys, as x, y, z, x, y, z, ...
void write_vertices(const Grid& grid, const KeyBlend& at, float scale, float* xyz) {
  for (int axis = 0; axis < 3; ++axis) {
    const float *from = grid.P(at.before, axis), *to = grid.P(at.after, axis);
    for (int k = 0; k < grid.vertex_count(); ++k) {
      xyz[3 * k + axis] = scale * (from[k] + at.share * (to[k] - from[k]));
    }
  }
}

}  // namespace

int even_intervals(std::span<const float> times) {
  const auto holds = [&](int intervals) {
    return std::all_of(times.begin(), times.end(), [&](float t) {
      const float step = t * float(intervals);
      return std::abs(step - std::round(step)) <= key_tolerance * float(intervals);
    });
  };
  for (int n = int(times.size()) - 1; n < most_intervals; ++n) {
    if (holds(n)) return n;
  }
  return most_intervals;
}

EmbreeScene::EmbreeScene(RayScene&& scene) {
  grids_ = std::move(scene.grids);
  scale_ = scale_of(grids_);
  describe_grids(scene);
  // Not its option "threads": that limits everybody's use of TBB as long as the device lives.
  device_ = rtcNewDevice(nullptr);
  if (!device_) {
    throw Error(fmt::format("Embree does not start: error {}", int(rtcGetDeviceError(nullptr))));
  }
  rtcSetDeviceMemoryMonitorFunction(device_, &EmbreeScene::count_memory, this);
  scene_ = rtcNewScene(device_);
  rtcSetSceneFlags(scene_, RTC_SCENE_FLAG_ROBUST | RTC_SCENE_FLAG_CONTEXT_FILTER_FUNCTION);
  std::map<std::vector<float>, std::vector<uint32_t>> by_keys;
  for (uint32_t g = 0; g < grids_.size(); ++g) by_keys[grids_[g]->key_times].push_back(g);
  try {
    for (const auto& [times, grids] : by_keys) add_geometry(grids, scene);
    tbb::task_arena(scene.threads).execute([this] { rtcCommitScene(scene_); });
    check("building the tree of the scene");
  } catch (...) {
    release();
    throw;
  }
}

EmbreeScene::~EmbreeScene() { release(); }

void EmbreeScene::release() {
  if (scene_) rtcReleaseScene(scene_);
  if (device_) rtcReleaseDevice(device_);
}

bool EmbreeScene::count_memory(void* self, ssize_t bytes, bool) {
  static_cast<EmbreeScene*>(self)->embree_bytes_ += bytes;
  return true;
}

void EmbreeScene::check(const char* doing) const {
  const RTCError error = rtcGetDeviceError(device_);
  if (error == RTC_ERROR_OUT_OF_MEMORY) {
    throw Error(fmt::format("rays: out of memory while {}", doing));
  }
  if (error != RTC_ERROR_NONE) {
    throw Error(fmt::format("rays: Embree reports error {} while {}", int(error), doing));
  }
}

void EmbreeScene::describe_grids(const RayScene& scene) {
  met_grids_.resize(grids_.size());
  for (size_t g = 0; g < grids_.size(); ++g) {
    const float passing = scene.passing[g];
    MetGrid& met = met_grids_[g];
    met.opaque = passing <= 0;
    met.blocks = passing < 1;
    if (!met.opaque) met.log2_passing = std::llround(std::log2(double(passing)) * 0x1p32);
    opaque_ = opaque_ && met.opaque;
  }
}

void EmbreeScene::add_geometry(std::span<const uint32_t> grids, RayScene& scene) {
  auto met = std::make_unique<MetGeometry>();
  met->grids = met_grids_.data();
  for (uint32_t g : grids) {
    met_grids_[g].first_micropolygon = uint32_t(met->micropolygons.size());
    for (const NearRange& near : scene.near[g]) {
      const NearRange scaled{near.height * scale_, near.reach * scale_};
      met->micropolygons.push_back({scaled, grids_[g]->surface->id, g});
    }
    scene.near[g] = {};
  }
  const OwnGeometry geometry(rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE));
  check("starting on triangles");
  fill_triangles(geometry.get(), grids);
  fill_vertices(geometry.get(), grids);
  rtcSetGeometryUserData(geometry.get(), met.get());
  rtcCommitGeometry(geometry.get());
  rtcAttachGeometryByID(scene_, geometry.get(), unsigned(geometries_.size()));
  geometries_.push_back(std::move(met));
  check("handing over triangles");
}

void EmbreeScene::fill_triangles(RTCGeometry geometry, std::span<const uint32_t> grids) const {
  auto* corner = static_cast<uint32_t*>(
      rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                              3 * sizeof(uint32_t), triangle_count(grids, grids_)));
  check("making room for triangles");
  uint32_t first_vertex = 0;
  for (uint32_t g : grids) {
    const Grid& grid = *grids_[g];
    for (uint32_t t = 0; t < 2 * uint32_t(grid.micropolygon_count()); ++t) {
      for (int vertex : grid.triangle_corners(t)) *corner++ = first_vertex + uint32_t(vertex);
    }
    first_vertex += uint32_t(grid.vertex_count());
  }
}

void EmbreeScene::fill_vertices(RTCGeometry geometry, std::span<const uint32_t> grids) const {
  const std::vector<float>& times = grids_[grids.front()]->key_times;
  const int intervals = times.size() > 1 ? even_intervals(times) : 0;
  rtcSetGeometryTimeStepCount(geometry, unsigned(intervals) + 1);
  for (int step = 0; step <= intervals; ++step) {
    auto* xyz = static_cast<float*>(
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, unsigned(step), RTC_FORMAT_FLOAT3,
                                3 * sizeof(float), vertex_count(grids, grids_)));
    check("making room for vertices");
    const float t = intervals > 0 ? float(step) / float(intervals) : 0.0f;
    const KeyBlend at(*grids_[grids.front()], t);
    for (uint32_t g : grids) {
      write_vertices(*grids_[g], at, scale_, xyz);
      xyz += 3 * grids_[g]->vertex_count();
    }
  }
}

size_t EmbreeScene::memory_bytes() const {
  size_t bytes = size_t(std::max<ssize_t>(0, embree_bytes_)) + met_grids_.size() * sizeof(MetGrid);
  for (const auto& grid : grids_) bytes += grid->memory_bytes();
  for (const auto& geometry : geometries_) {
    bytes += geometry->micropolygons.size() * sizeof(MetMicropolygon);
  }
  return bytes;
}

}  // namespace tessera

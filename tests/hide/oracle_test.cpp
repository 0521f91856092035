/// The hiders against rays: a long double Moeller-Trumbore test over all triangles, and Embree.
/// Both trace Camera::ray_camera through camera-space triangles and know nothing of raster clip
/// space.

#include <catch2/catch.hpp>

#include <cmath>

#include <embree3/rtcore.h>

#include "hide/dual_bounds.h"
#include "tests/hide/random_scenes.h"
#include "tests/hide/ray_oracle.h"

using namespace tessera;

namespace {

struct Tally {
  size_t compared = 0, doubtful = 0, hits = 0;
};

void compare_with_rays(const TestBucket& bucket, Tally& tally) {
  const FragmentList list = bucket.hide("bbox");
  for (size_t s = 0; s < bucket.samples.size(); ++s) {
    ++tally.compared;
    const RayHit expected = trace(bucket, s);
    if (expected.doubtful) {
      ++tally.doubtful;
      continue;
    }
    const Comparison c = compare(expected, list, s);
    INFO("sample " << s << " z " << double(expected.z) << " depth error " << double(c.depth_error));
    REQUIRE(c.agrees);
    if (expected.layers == 0) continue;
    ++tally.hits;
    const size_t first = list.first_of_sample[s];
    REQUIRE(list.first_of_sample[s + 1] - first == 1);
    REQUIRE(c.depth_error < 2e-5);
    if (list.grid[first] != uint32_t(expected.grid) ||
        list.triangle[first] != uint32_t(expected.triangle))
      continue;  // two surfaces at the same depth within rounding
    // The barycentrics give back the point on the ray.
    const Grid& grid = *bucket.grids[list.grid[first]];
    const auto v = triangle_vertices(grid, int(list.triangle[first]));
    const SampleRay r = sample_ray(bucket, s);
    const double b1 = list.b1[first], b2 = list.b2[first];
    const glm::dvec3 p = (1 - b1 - b2) * vertex_at(grid, v[0], r.t) +
                         b1 * vertex_at(grid, v[1], r.t) + b2 * vertex_at(grid, v[2], r.t);
    const glm::dvec3 q = r.ray.origin + r.ray.direction * double(expected.z);
    REQUIRE(glm::length(p - q) < 2e-4 * double(expected.z));
  }
}

}  // namespace

TEST_CASE("The sample test agrees with long double rays") {
  for (const bool orthographic : {false, true})
    for (const bool motion : {false, true})
      for (const bool lens : {false, true}) {
        Tally tally;
        for (uint32_t seed = 40; seed < 43; ++seed) {
          RandomOptions o{.motion = motion, .lens = lens, .orthographic = orthographic};
          o.reach = 2, o.grid_size = 3, o.keys = 2 + int(seed % 2);
          compare_with_rays(random_bucket(seed, o, {20, 12, 36, 28}, 4, 8), tally);
        }
        // Eyes among the grids.
        if (!orthographic)
          compare_with_rays(random_bucket(50,
                                          {.motion = motion,
                                           .lens = lens,
                                           .reach = 1,
                                           .depth_min = -1,
                                           .depth_max = 2,
                                           .grid_size = 3},
                                          {20, 12, 36, 28}, 4, 8),
                            tally);
        INFO("orthographic " << orthographic << " motion " << motion << " lens " << lens << ": "
                             << tally.doubtful << " doubtful and " << tally.hits << " hits of "
                             << tally.compared);
        REQUIRE(tally.hits > tally.compared / 8);
        // Edges take up as much of the area of each layer as positions are rounded by.
        REQUIRE(tally.doubtful < tally.compared / 20);
      }
}

namespace {

/// Every sample that a block of size x size micropolygons covers, by long double rays, is within
/// the block's bounds and within the intervals of its pixel.
void require_bounds(const TestBucket& bucket, const Grid& grid, const ClipSegment& segment,
                    const CoverageFrame& frame, const SampleBox& box, int size) {
  for (int k = 0; k < 2 * grid.micropolygon_count(); ++k) {
    const int i = k / 2 % grid.u_count / size * size, j = k / 2 / grid.u_count / size * size;
    const GridBlock block{i, j, std::min(i + size, grid.u_count), std::min(j + size, grid.v_count)};
    const BlockBounds bounds = bound_block(segment, grid.u_count, frame, box, block);
    const auto v = triangle_vertices(grid, k);
    for (size_t s = 0; s < bucket.samples.size(); ++s) {
      const SampleRay r = sample_ray(bucket, s);
      if (r.t < segment.t_begin || r.t > segment.t_end) continue;
      const Meeting m = meet(r.ray, {vertex_at(grid, v[0], r.t), vertex_at(grid, v[1], r.t),
                                     vertex_at(grid, v[2], r.t)});
      if (!(m.margin() >= 0) || m.distance < frame.near_clip) continue;
      const double tau = (r.t - segment.t_begin) / (segment.t_end - segment.t_begin);
      const bool lens = !bucket.samples.u.empty();
      for (int axis = 0; axis < 2; ++axis) {
        const float at = axis == 0 ? bucket.samples.x[s] : bucket.samples.y[s];
        const double l = !lens ? 0 : double(axis == 0 ? bucket.samples.u[s] : bucket.samples.v[s]);
        const ShearFrame& f = bounds.shear;
        const double S = f.per_p[axis] * (double(at) - box.middle[axis]) + f.per_l[axis] * l +
                         f.per_t[axis] * tau;
        REQUIRE((bounds.low[axis] <= S && S <= bounds.high[axis]));
        const SampleInterval interval =
            tile_interval(bounds, box, axis, std::floor(at), std::floor(at) + 1);
        REQUIRE((interval.t_min <= tau && tau <= interval.t_max));
        REQUIRE((interval.l_min <= l && l <= interval.l_max));
      }
    }
  }
}

}  // namespace

TEST_CASE("Bounds never exclude a covered sample") {
  for (const bool motion : {false, true})
    for (const bool lens : {false, true})
      for (uint32_t seed = 60; seed < 64; ++seed) {
        RandomOptions o{.motion = motion, .lens = lens};
        o.reach = 2, o.depth_min = seed % 2 ? -1.0f : 3.0f, o.speed = 2;
        const TestBucket bucket = random_bucket(seed, o, {20, 12, 36, 28}, 4, 3);
        HideInput input;
        input.raster_clip = bucket.camera.raster_clip();
        input.near_clip = bucket.camera.near_clip(), input.far_clip = bucket.camera.far_clip();
        const SampleBox box(bucket.samples.rect, lens ? 1.0f : 0.0f);
        ClipGrid clip;
        for (const auto& grid : bucket.grids) {
          clip.set(*grid, input.raster_clip);
          for (const ClipSegment& segment : clip.segments())
            for (const int size : {1, 2, 4, 16})
              require_bounds(bucket, *grid, segment, coverage_frame(input, *grid, segment), box,
                             size);
        }
      }
}

namespace {

/// A bucket's grids as Embree triangles.
class EmbreeScene {
 public:
  explicit EmbreeScene(const TestBucket& bucket)
      : device_(rtcNewDevice(nullptr)), scene_(rtcNewScene(device_)) {
    rtcSetSceneFlags(scene_, RTC_SCENE_FLAG_ROBUST);
    for (const auto& grid : bucket.grids) {
      RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
      rtcSetGeometryTimeStepCount(geometry, unsigned(grid->key_count()));
      for (int key = 0; key < grid->key_count(); ++key) {
        auto* p = static_cast<float*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX,
                                                              unsigned(key), RTC_FORMAT_FLOAT3, 12,
                                                              size_t(grid->vertex_count())));
        for (int i = 0; i < grid->vertex_count(); ++i)
          for (int axis = 0; axis < 3; ++axis) p[i * 3 + axis] = grid->P(key, axis)[i];
      }
      auto* index = static_cast<uint32_t*>(
          rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 12,
                                  size_t(2 * grid->micropolygon_count())));
      for (int k = 0; k < 2 * grid->micropolygon_count(); ++k)
        for (const int v : triangle_vertices(*grid, k)) *index++ = uint32_t(v);
      rtcCommitGeometry(geometry);
      rtcAttachGeometry(scene_, geometry);
      rtcReleaseGeometry(geometry);
    }
    rtcCommitScene(scene_);
  }
  ~EmbreeScene() {
    rtcReleaseScene(scene_);
    rtcReleaseDevice(device_);
  }
  EmbreeScene(const EmbreeScene&) = delete;

  RTCRayHit trace(const SampleRay& r, float near_clip) const {
    RTCRayHit h{};
    h.ray.org_x = float(r.ray.origin.x), h.ray.org_y = float(r.ray.origin.y),
    h.ray.org_z = float(r.ray.origin.z);
    h.ray.dir_x = float(r.ray.direction.x), h.ray.dir_y = float(r.ray.direction.y),
    h.ray.dir_z = float(r.ray.direction.z);
    h.ray.tnear = near_clip, h.ray.tfar = INFINITY, h.ray.time = float(r.t), h.ray.mask = ~0u;
    h.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    rtcIntersect1(scene_, &context, &h);
    return h;
  }

 private:
  RTCDevice device_;
  RTCScene scene_;
};

}  // namespace

TEST_CASE("The hiders agree with Embree except within rounding of an edge") {
  for (const bool motion : {false, true})
    for (const bool lens : {false, true}) {
      // Keys evenly spaced, as Embree has them.
      RandomOptions o{.motion = motion, .lens = lens};
      o.reach = 2, o.grid_size = 3;
      size_t compared = 0, differ = 0, hits = 0;
      for (uint32_t seed = 70; seed < 76; ++seed) {
        const TestBucket bucket = random_bucket(seed, o, {8, 8, 56, 40}, 16, 16);
        const EmbreeScene scene(bucket);
        const FragmentList list = bucket.hide("shear");
        for (size_t s = 0; s < bucket.samples.size(); ++s) {
          const RTCRayHit h = scene.trace(sample_ray(bucket, s), bucket.camera.near_clip());
          const size_t first = list.first_of_sample[s];
          const bool seen = list.first_of_sample[s + 1] > first;
          const bool embree_seen = h.hit.geomID != RTC_INVALID_GEOMETRY_ID;
          ++compared, hits += embree_seen;
          const bool same =
              seen == embree_seen && (!seen || (list.z[first] == Approx(h.ray.tfar).epsilon(1e-4)));
          if (same) continue;
          ++differ;
          // Every disagreement is at an edge, by the long double rays.
          REQUIRE(trace(bucket, s).doubtful);
        }
      }
      INFO("motion " << motion << " lens " << lens << ": " << differ << " of " << compared
                     << " differ");
      REQUIRE(hits > compared / 4);
      REQUIRE(differ < compared / 10000);
    }
}

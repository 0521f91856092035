#include "rays/embree/ray_query.h"

#include <algorithm>
#include <cmath>

namespace tessera {

namespace {

/// Distance between hits on one layer, relative to the distance along the ray.
constexpr float layer_noise = 4e-6f;

/// A hit that Embree proposes.
struct Proposal {
  RayQuery& query;
  const MetGeometry& geometry;
  const RTCRay& ray;
  const RTCHit& hit;
  const MetMicropolygon& micropolygon;

  explicit Proposal(const RTCFilterFunctionNArguments& arguments)
      : query(*reinterpret_cast<RayQuery*>(arguments.context)),
        geometry(*static_cast<const MetGeometry*>(arguments.geometryUserPtr)),
        ray(*reinterpret_cast<const RTCRay*>(arguments.ray)),
        hit(*reinterpret_cast<const RTCHit*>(arguments.hit)),
        micropolygon(geometry.micropolygons[hit.primID / 2]) {}

  const MetGrid& grid() const { return geometry.grids[micropolygon.grid]; }

  /// Whether the origin lies on the surface that this triangle stands for, hereabouts.
  bool is_own_neighbourhood() const {
    if (micropolygon.surface != query.surface) return false;
    const float scale = std::max({std::abs(hit.Ng_x), std::abs(hit.Ng_y), std::abs(hit.Ng_z)});
    if (!(scale > 0)) return true;
    const float x = hit.Ng_x / scale, y = hit.Ng_y / scale, z = hit.Ng_z / scale;
    const float along = x * ray.dir_x + y * ray.dir_y + z * ray.dir_z;
    const float height = ray.tfar * std::abs(along) / std::sqrt(x * x + y * y + z * z);
    const NearRange& near = micropolygon.near;
    return height <= query.height_noise || (height <= near.height && ray.tfar <= near.reach);
  }

  bool keep() const {
    const uint64_t name = uint64_t(hit.geomID) << 32 | hit.primID;
    if (ray.tfar > query.kept_t || (ray.tfar == query.kept_t && name > query.kept_name))
      return false;
    query.kept_t = ray.tfar;
    query.kept_name = name;
    return true;
  }

  void take_down_layer() const {
    const float t = ray.tfar, noise = query.height_noise + layer_noise * t;
    const auto is_this = [&](const RayQuery::Layer& l) {
      return l.surface == micropolygon.surface && std::abs(l.t - t) <= noise;
    };
    const auto end = query.layers.begin() + long(query.layer_count);
    query.nearest_layer_t = std::min(query.nearest_layer_t, t);
    if (std::any_of(query.layers.begin(), end, is_this)) return;
    if (std::ranges::any_of(query.further_layers, is_this)) return;
    query.log2_passing += grid().log2_passing;
    const RayQuery::Layer layer{micropolygon.surface, t};
    if (query.layer_count < query.layers.size()) {
      query.layers[query.layer_count++] = layer;
    } else {
      query.further_layers.push_back(layer);
    }
  }
};

}  // namespace

void keep_nearest(const RTCFilterFunctionNArguments* arguments) {
  const Proposal proposal(*arguments);
  const bool met = !proposal.is_own_neighbourhood() && proposal.keep();
  if (!met) arguments->valid[0] = 0;
}

void keep_nearest_opaque(const RTCFilterFunctionNArguments* arguments) {
  const Proposal proposal(*arguments);
  bool met = proposal.grid().blocks && !proposal.is_own_neighbourhood();
  if (met && !proposal.grid().opaque) {
    proposal.take_down_layer();
    met = false;
  }
  if (!met || !proposal.keep()) arguments->valid[0] = 0;
}

}  // namespace tessera

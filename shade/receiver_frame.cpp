#include "shade/receiver_frame.h"

#include <algorithm>
#include <cmath>

#include "shade/mathematics.h"

namespace tessera {
namespace {

/// Sine of the smallest angle between light and surface that shadows are carried along.
constexpr float least_sine = 0.05f;

}  // namespace

ReceiverFrame ReceiverFrame::at(const Camera& camera, const glm::vec3& P, const glm::vec3& N) {
  const RasterClipMap& map = camera.raster_clip();
  const float w = camera.raster_clip_from_camera(P).z;
  if (!(w > 0.0f)) return {};
  // raster x = x_scale * x / W + x_from_w, where W depends on z alone.
  const float dw = map.w_from_z / w;
  const glm::vec3 of_raster[] = {map.x_scale / w * glm::vec3(1.0f, 0.0f, -P.x * dw),
                                 map.y_scale / w * glm::vec3(0.0f, 1.0f, -P.y * dw)};
  ReceiverFrame frame;
  for (size_t axis = 0; axis < 2; ++axis) {
    frame.row[axis] = of_raster[axis] - N * glm::dot(N, of_raster[axis]);
    if (!is_finite(frame.row[axis])) return {};
  }
  return frame;
}

ReceiverFrame ReceiverFrame::projected_along(const glm::vec3& L, const glm::vec3& N) const {
  const float sine = glm::dot(N, L);
  const float bounded = std::copysign(std::max(std::abs(sine), least_sine), sine);
  // row . (Y - L (N . Y) / (N . L)), as a row for Y.
  ReceiverFrame frame;
  for (size_t axis = 0; axis < 2; ++axis) {
    frame.row[axis] = row[axis] - N * (glm::dot(row[axis], L) / bounded);
  }
  return frame;
}

EffectCoordinate effect_coordinate(const glm::vec2& pixels, const glm::vec2& reach) {
  EffectCoordinate coordinate;
  for (int axis = 0; axis < 2; ++axis) {
    if (!(reach[axis] > 0.0f) || !std::isfinite(reach[axis])) continue;
    const float y = pixels[axis] / reach[axis];
    if (!std::isfinite(y)) continue;
    coordinate.extent[axis] = reach[axis];
    coordinate.y[axis] = std::clamp(y, -farthest_coordinate, farthest_coordinate);
  }
  return coordinate;
}

void set_coordinate(size_t i, const EffectCoordinate& coordinate, ShareSamples& out) {
  for (size_t axis = 0; axis < 2; ++axis) {
    out.y[axis][i] = coordinate.y[int(axis)];
    out.extent[axis][i] = coordinate.extent[int(axis)];
  }
}

glm::vec2 reach_of(const LightExtent& extent, const ReceiverFrame& frame) {
  if (extent.infinite) return disc_spread * frame.reach_of_unit_disc();
  glm::vec2 squares(0.0f);
  for (const glm::vec3& half_axis : extent.half_axes) {
    const glm::vec2 q = frame.pixels(half_axis);
    squares += q * q;
  }
  return (extent.round ? disc_spread : 1.0f) * glm::sqrt(squares);
}

}  // namespace tessera

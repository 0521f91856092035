#include "hide/quad.h"

#include <cmath>
#include <limits>

namespace tessera {
namespace {

/// Which sign of the summed edge functions a visible triangle has.
///
/// For triangle (p, q, r) of camera points and eye E, sum(e) * z = det M * dot(p - E, (q - p) x
/// (r - p)), with det M = x_scale * y_scale: expand the determinant of the (X, Y, W) rows by W,
/// which the shear to dx, dy leaves as it is. A point is seen only at z >= near >= 0, so the sign
/// of sum(e) tells on which side of the triangle the eye is; it is seen from outside if dot(p - E,
/// N) < 0. For an orthographic camera, W = 1, and the sum is det M times the z of the cross
/// product, the viewing direction: the same rule.
float facing_of(const Grid& grid, const RasterClipMap& map) {
  if (!grid.one_sided) return 0.0f;
  return std::copysign(1.0f, map.x_scale) * std::copysign(1.0f, map.y_scale) * -grid.normal_sign;
}

}  // namespace

CoverageFrame coverage_frame(const HideInput& input, const Grid& grid, const ClipSegment& segment) {
  CoverageFrame f;
  f.coc_x = input.raster_clip.coc_x, f.coc_y = input.raster_clip.coc_y;
  f.near_clip = input.near_clip, f.far_clip = input.far_clip;
  f.t_begin = segment.t_begin, f.inverse_duration = segment.inverse_duration;
  f.t_last = segment.last ? segment.t_end : std::nextafter(segment.t_end, 0.0f);
  f.facing = facing_of(grid, input.raster_clip);
  return f;
}

SampleArrays sample_arrays(const SampleBlock& block) {
  const auto pointer = [](const AlignedVector<float>& a) { return a.empty() ? nullptr : a.data(); };
  return {block.x.data(), block.y.data(), pointer(block.u), pointer(block.v), pointer(block.t)};
}

}  // namespace tessera

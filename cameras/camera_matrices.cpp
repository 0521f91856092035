#include "cameras/camera_matrices.h"

namespace tessera {

CameraMatrices camera_matrices(const Camera& camera) {
  const RasterClipMap& map = camera.raster_clip();
  const double width = camera.frame().width(), height = camera.frame().height();
  const glm::dvec4 w(0.0, 0.0, map.w_from_z, map.w_constant);
  const glm::dvec4 x = glm::dvec4(map.x_scale, 0, 0, 0) + double(map.x_from_w) * w;
  const glm::dvec4 y = glm::dvec4(0, map.y_scale, 0, 0) + double(map.y_from_w) * w;
  const double near_z = camera.near_clip(), far_z = camera.far_clip();
  const double scale = camera.perspective() ? 1.0 / (1.0 - near_z / far_z) : 1.0 / (far_z - near_z);
  const glm::dvec4 z(0.0, 0.0, scale, -near_z * scale);
  const glm::dmat4 ndc_from_camera = glm::transpose(glm::dmat4(x / width, y / height, z, w));
  const glm::dmat4 camera_from_world = camera.camera_from_world(0.0f);
  return {camera_from_world, ndc_from_camera * camera_from_world};
}

}  // namespace tessera

/// Orientation, by its definition: the normal of a sphere points outward in camera space whatever
/// the transforms reflect, unless the scene turns it.

#include "rib_test_utils.h"

using namespace tessera;
using namespace tessera::test;

namespace {

/// Whether the normal that flip_normal prescribes points away from the centre of the unit sphere:
/// takes cross(dP/du, dP/dv) in world space at one point, flips it, carries it to camera space.
bool points_outward(const Scene& scene, size_t i) {
  const Surface& surface = scene.surfaces.at(i);
  const glm::dmat3 world(surface.world_from_object.at(0));
  const glm::dmat3 camera(scene.camera.camera_from_world.at(0));
  // At object (1, 0, 0): u runs about z, v towards +z.
  glm::dvec3 N_world = glm::cross(world * glm::dvec3(0, 1, 0), world * glm::dvec3(0, 0, 1));
  if (surface.flip_normal) N_world = -N_world;
  const glm::dvec3 N_camera = glm::transpose(glm::inverse(camera)) * N_world;
  return glm::dot(N_camera, camera * world * glm::dvec3(1, 0, 0)) > 0;
}

bool outward(const std::string& camera, const std::string& world) {
  const auto result = read_text(camera + " WorldBegin " + world + " Sphere 1 -1 1 360 WorldEnd");
  return points_outward(result.scene(), 0);
}

const std::string mirror = "Scale 1 1 -1 ";

}  // namespace

TEST_CASE("the default orientation points outward under any reflection") {
  for (const std::string& camera : {std::string(""), mirror, mirror + "Rotate 30 1 1 1"})
    for (const std::string& world :
         {std::string(""), mirror, mirror + mirror, "Rotate 50 0 1 0 " + mirror + "Scale 2 3 4 "}) {
      CAPTURE(camera, world);
      CHECK(outward(camera, world));
      CHECK(outward(camera, world + "Orientation \"outside\""));
      CHECK_FALSE(outward(camera, world + "Orientation \"inside\""));
      CHECK_FALSE(outward(camera, world + "ReverseOrientation"));
      CHECK(outward(camera, world + "Orientation \"inside\" ReverseOrientation"));
      CHECK_FALSE(outward(camera, "ReverseOrientation " + world));
    }
}

TEST_CASE("lh and rh name a handedness, which then flips along with the space") {
  // Camera space is left-handed, so there "lh" is the outside.
  CHECK(outward("", "Orientation \"lh\""));
  CHECK_FALSE(outward("", "Orientation \"rh\""));
  CHECK_FALSE(outward("", mirror + "Orientation \"lh\""));
  CHECK(outward("", mirror + "Orientation \"rh\""));
  CHECK(outward("", "Orientation \"lh\"" + mirror));
  CHECK_FALSE(outward(mirror, "Orientation \"lh\""));
  CHECK(outward(mirror, mirror + "Orientation \"lh\""));
  CHECK(outward(mirror, "Orientation \"rh\""));
  CHECK(outward("Orientation \"lh\"", ""));
}

TEST_CASE("flip_normal itself is in world space") {
  const auto result = read_text(
      "Scale 1 1 -1 WorldBegin Sphere 1 -1 1 360 AttributeBegin Scale -1 1 "
      "1 Sphere 1 -1 1 360 AttributeEnd ReverseOrientation Sphere 1 -1 1 "
      "360 WorldEnd");
  CHECK_FALSE(result.scene().surfaces[0].flip_normal);
  CHECK(result.scene().surfaces[1].flip_normal);
  CHECK(result.scene().surfaces[2].flip_normal);
}

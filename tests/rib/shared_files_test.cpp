/// Scene files written by other people, where they are at hand.

#include "rib_test_utils.h"

using namespace tessera;
using namespace tessera::test;

namespace {

const std::string shared = std::string(TESSERA_SOURCE_DIR) + "/../shared/rib/";

bool absent(const std::string& file) {
  if (std::filesystem::exists(shared + file)) return false;
  WARN("skipped: no " << file);
  return true;
}

}  // namespace

TEST_CASE("bike.rib: a gzipped archive of bicubic patches") {
  if (absent("bike.rib")) return;
  const auto result = read_file(shared + "bike.rib");
  REQUIRE(result.frames.size() == 1);
  const Scene& scene = result.scene();
  CHECK(result.warnings.empty());
  CHECK(scene.surfaces.size() == 5216);
  CHECK(scene.lights.size() == 4);
  CHECK(scene.displays.size() == 2);
  CHECK(scene.options.exposure_gamma == 2.2f);
  CHECK(scene.options.bucket_size.value() == 32);
  CHECK(scene.frame_number == 1);
  // The lights stand in the world: they were declared with the finished camera transform.
  const glm::dmat4 placed = scene.lights[1].shader.world_from_shader.at(0);
  CHECK(glm::length(glm::dvec3(placed[3])) < 1e-9);
}

TEST_CASE("creases.rib: a creased mesh of triangles, a light handle used twice") {
  if (absent("creases.rib")) return;
  const auto result = read_file(shared + "creases.rib");
  const Scene& scene = result.scene();
  CHECK(result.warnings.empty());
  REQUIRE(scene.surfaces.size() == 1);
  CHECK(scene.surfaces[0].attributes->lights == std::vector<int>{0, 1});
  const auto& mesh = std::get<SubdivisionMesh>(scene.surfaces[0].geometry->shape);
  CHECK(mesh.creases.size() == 8);
  CHECK(mesh.creases[7].sharpness == 2);
}

TEST_CASE("simpledeformation.rib: deforming patches through an open lens") {
  if (absent("simpledeformation.rib")) return;
  const auto result = read_file(shared + "simpledeformation.rib");
  const Scene& scene = result.scene();
  REQUIRE(scene.surfaces.size() == 2);
  CHECK(scene.camera.lens->focal_distance == 1.5);
  CHECK(scene.surfaces[0].geometry->key_times == std::vector<float>{0, 1});
  CHECK(scene.surfaces[1].geometry->P_object[1][0] == glm::vec3(1.5f, 0, 2));
}

TEST_CASE("vase.rib: frames, shaders nobody knows, a depth map") {
  if (absent("vase.rib")) return;
  const auto result = read_file(shared + "vase.rib");
  REQUIRE(result.frames.size() == 3);
  CHECK(result.frames[0]->displays.at(0).type == "zfile");
  size_t surfaces = 0;
  for (const auto& frame : result.frames) surfaces += frame->surfaces.size();
  CHECK(surfaces == 126 + 18);
}

TEST_CASE("statuemodel.rib: an archive without a world, read from a scene") {
  if (absent("statuemodel.rib")) return;
  CollectFrames sink;
  Diagnostics diagnostics;
  read_rib_text("Projection \"perspective\" WorldBegin ReadArchive \"statuemodel.rib\" WorldEnd",
                "scene.rib", sink, diagnostics, {{shared}});
  REQUIRE(sink.frames.at(0)->surfaces.size() == 1);
  const Surface& statue = sink.frames[0]->surfaces[0];
  CHECK(statue.flip_normal);
  const auto& mesh = std::get<PolygonMesh>(statue.geometry->shape);
  CHECK(mesh.vertices_per_loop.size() == mesh.loops_per_polygon.size());
  CHECK(statue.geometry->primvars.at(0).name == "N");
  CHECK_THROWS_WITH(read_file(shared + "statuemodel.rib"), Contains("outside of any world"));
}

/// Object definitions and instances, archives in files and inline, gzip.

#include <zlib.h>

#include "rib_test_utils.h"

using namespace tessera;
using namespace tessera::test;

namespace {

glm::dvec3 origin(const Scene& scene, size_t i) {
  return glm::dvec3(scene.surfaces.at(i).world_from_object.at(0)[3]);
}

std::string gzipped(const std::string& text, const std::string& path) {
  gzFile file = gzopen(path.c_str(), "wb");
  gzwrite(file, text.data(), unsigned(text.size()));
  gzclose(file);
  return path;
}

}  // namespace

TEST_CASE("instances take the instance's attributes except those set inside") {
  const auto result = read_text(R"(
    Shutter 0 1  Translate 0 0 5
    ObjectBegin 1
      Sphere 1 -1 1 360
      Color 1 0 0  Surface "matte"  Translate 1 0 0
      MotionBegin [0 1] Disk 0 1 360 Disk 1 1 360 MotionEnd
      Sphere 2 -2 2 360
    ObjectEnd
    WorldBegin
      Color 0 0 1  Sides 1
      TransformBegin Translate 0 10 0 ObjectInstance 1 TransformEnd
      Scale -1 1 1  ObjectInstance "1"
    WorldEnd)");
  const Scene& scene = result.scene();
  REQUIRE(scene.surfaces.size() == 6);
  CHECK(scene.surfaces[0].attributes->color == glm::vec3(0, 0, 1));
  CHECK(scene.surfaces[1].attributes->color == glm::vec3(1, 0, 0));
  CHECK_FALSE(scene.surfaces[1].attributes->two_sided);
  CHECK(scene.surfaces[1].attributes == scene.surfaces[2].attributes);
  CHECK(origin(scene, 1) == glm::dvec3(1, 10, 0));
  CHECK(origin(scene, 4) == glm::dvec3(-1, 0, 0));
  // Geometry is shared; the shader's space goes along with the instance.
  CHECK(scene.surfaces[1].geometry == scene.surfaces[4].geometry);
  CHECK(scene.surfaces[1].geometry->key_times == std::vector<float>{0, 1});
  CHECK(glm::dvec3(scene.surfaces[1].attributes->surface->world_from_shader.at(0)[3]) ==
        glm::dvec3(0, 10, 0));
  CHECK_FALSE(scene.surfaces[1].flip_normal);
  CHECK(scene.surfaces[4].flip_normal);
  CHECK(scene.surfaces[5].id == 5);
}

TEST_CASE("objects within objects, moving instances, and missing ones") {
  const auto result = read_text(
      "Shutter 0 1 WorldBegin ObjectBegin \"a\" Color 1 0 0 Sphere 1 -1 1 360 ObjectEnd "
      "ObjectBegin "
      "\"b\" Translate 1 0 0 ObjectInstance \"a\" Translate 1 0 0 ObjectInstance \"a\" ObjectEnd "
      "MotionBegin [0 1] Translate 0 0 0 Translate 0 2 0 MotionEnd ObjectInstance \"b\" WorldEnd");
  REQUIRE(result.scene().surfaces.size() == 2);
  CHECK(origin(result.scene(), 1) == glm::dvec3(2, 0, 0));
  CHECK(result.scene().surfaces[1].world_from_object.at(1)[3].y == 2);
  CHECK(result.scene().surfaces[1].attributes->color == glm::vec3(1, 0, 0));
  CHECK_THAT(error_in_world("ObjectInstance 7"), Contains("no object has the handle \"7\""));
  CHECK_THAT(error_in_world("ObjectBegin 1 ObjectInstance 1 ObjectEnd"), Contains("no object"));
  CHECK_THAT(error_in_world("ObjectBegin 1 ObjectBegin 2"),
             Contains("between ObjectBegin and its end"));
}

TEST_CASE("objects that multiply are stopped") {
  std::string text = "ObjectBegin 0 Sphere 1 -1 1 360 ObjectEnd ";
  for (int level = 1; level < 12; ++level) {
    text += fmt::format("ObjectBegin {} ", level);
    for (int i = 0; i < 8; ++i) text += fmt::format("ObjectInstance {} ", level - 1);
    text += "ObjectEnd ";
  }
  CHECK_THAT(error_in_world(text), Contains("an object of more than"));
}

TEST_CASE("archives: beside the file, on the search path, compressed, inline") {
  const TestFolder folder("archives");
  folder.write("near.rib", "Translate 1 0 0 ReadArchive \"deep/inner.rib\"");
  folder.write("deep/inner.rib", "Sphere 1 -1 1 360 ReadArchive \"beside.rib\"");
  folder.write("deep/beside.rib", "Disk 0 1 360");
  folder.write("path/far.rib", "Cone 1 1 360");
  folder.write("extra/other.rib", "Torus 1 .1 0 360 360");
  gzipped("Translate 0 1 0 Cylinder 1 0 1 360", folder / "packed.rib.gz");
  const std::string scene = folder.write("scene.rib", R"(
    Option "searchpath" "archive" ["path:&"]
    ArchiveBegin "in" "string x" "y"
      AttributeBegin ArchiveBegin "nested" Sphere 5 -5 5 360 ArchiveEnd
      Sphere 3 -3 3 360 AttributeEnd
    ArchiveEnd
    WorldBegin
      ReadArchive "near.rib"  ReadArchive "packed.rib.gz"  ReadArchive "far.rib"
      ReadArchive "other.rib"  ReadArchive "in"  ReadArchive "nested"
    WorldEnd)");
  const auto result = read_file(scene, {{folder / "extra"}});
  CHECK(result.scene().surfaces.size() == 7);
  CHECK(origin(result.scene(), 2) == glm::dvec3(1, 1, 0));
  CHECK_THAT(result.scene().surfaces[1].geometry->where.file, Contains("beside.rib"));
  CHECK(result.warnings.empty());
  const auto packed = read_file(gzipped("WorldBegin Sphere 1 -1 1 360 WorldEnd", folder / "s.gz"));
  CHECK(packed.scene().surfaces.size() == 1);
}

TEST_CASE("archives that cannot be found, read themselves or never end") {
  const TestFolder folder("bad_archives");
  const auto error_in = [](const std::string& path) -> std::string {
    try {
      read_file(path);
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  };
  const std::string lost = folder.write("lost.rib", "\nReadArchive \"none.rib\"");
  CHECK_THAT(error_in(lost), Contains("lost.rib:2: cannot find the archive \"none.rib\""));
  const std::string self = folder.write("self.rib", "ReadArchive \"self.rib\"");
  CHECK_THAT(error_in(self), Contains("self.rib:1: the archive \"self.rib\" reads itself"));
  const std::string a = folder.write("a.rib", "ReadArchive \"b.rib\"");
  folder.write("b.rib", "ReadArchive \"./a.rib\"");
  CHECK_THAT(error_in(a), Contains("b.rib:1") && Contains("reads itself"));
  std::string chain;
  for (int i = 0; i < 70; ++i)
    chain = folder.write(fmt::format("c{}.rib", i), fmt::format("ReadArchive \"c{}.rib\"", i - 1));
  CHECK_THAT(error_in(chain), Contains("nested more than 64 deep"));
  const std::string loop =
      folder.write("loop.rib", "ArchiveBegin \"x\" ReadArchive \"x\" ArchiveEnd ReadArchive \"x\"");
  CHECK_THAT(error_in(loop), Contains("nested more than 64 deep"));
  const std::string open = folder.write("open.rib", "ArchiveBegin \"x\" Sphere 1 -1 1 360");
  CHECK_THAT(error_in(open), Contains("ArchiveEnd was expected"));
  CHECK_THAT(error_in(folder / "missing.rib"), Contains("cannot open the scene file"));
  CHECK_THAT(error_in(folder / "."), Contains("cannot read"));
}

TEST_CASE("a gzip file that breaks off is an error") {
  const TestFolder folder("broken_gzip");
  std::string text = "WorldBegin\n";
  for (int i = 0; i < 20000; ++i) text += fmt::format("Translate {} {} 0\n", i * 7919 % 1013, i);
  const std::string path = gzipped(text + "WorldEnd", folder / "whole.rib.gz");
  CHECK(read_file(path).frames.size() == 1);
  std::filesystem::resize_file(path, std::filesystem::file_size(path) / 2);
  CHECK_THROWS_AS(read_file(path), Error);
}

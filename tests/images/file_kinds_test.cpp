#include <fstream>

#include <catch2/catch.hpp>

#include "base/error.h"
#include "images/exr.h"
#include "images/file_kinds.h"
#include "tests/images/temporary_folder.h"

using namespace tessera;

TEST_CASE("names tell formats in any case") {
  CHECK(lower_extension("a.b/C.ExR") == ".exr");
  CHECK(lower_extension("a.b/c") == "");
  for (const char* name : {"a.exr", "a.EXR", "x/.y.Exr"}) CHECK(named_exr(name));
  for (const char* name : {"a.exr.png", "exr", ".exr", ""}) CHECK_FALSE(named_exr(name));
  for (const char* name : {"a.png", "a.JPG", "a.Jpeg"}) CHECK(named_8_bit(name));
  for (const char* name : {"a.tif", "a.exr", "png"}) CHECK_FALSE(named_8_bit(name));
  for (const char* name : {"a.EXR", "a.png", "a.jpg", "a.jpeg", "a.TIF", "a.tiff"})
    CHECK_NOTHROW(check_format(name));
  for (const char* name : {"a", "a.gif", "a.z", "png", ""})
    CHECK_THROWS_AS(check_format(name), Error);
}

TEST_CASE("an EXR is told by how it begins") {
  const TemporaryFolder folder;
  Image image(4, 3);
  image.add_channel("Z");
  write_exr(folder.file("depth.z"), image);
  CHECK(holds_exr(folder.file("depth.z")));
  std::ofstream(folder.file("text.exr")) << "no picture";
  std::ofstream(folder.file("short.exr")) << "\x76\x2f\x31";
  CHECK_FALSE(holds_exr(folder.file("text.exr")));
  CHECK_FALSE(holds_exr(folder.file("short.exr")));
  CHECK_FALSE(holds_exr(folder.file("absent.exr")));
}

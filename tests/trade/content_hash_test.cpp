// Hashes that follow what a scene is made of.

#include <set>

#include <catch2/catch.hpp>

#include "base/error.h"
#include "tests/trade/trade_fixtures.h"
#include "trade/content_hash.h"

using namespace tessera;
using namespace tessera::trade;

TEST_CASE("the hash is FNV-1a") {
  // The published vectors of "", "a" and "foobar".
  const auto hash = [](const char* text) {
    ContentHash content;
    content.add(text);
    return content.value();
  };
  CHECK(hash("") == 0xcbf29ce484222325u);
  CHECK(hash("a") == 0xaf63dc4c8601ec8cu);
  CHECK(hash("foobar") == 0x85944171f73967e8u);
}

TEST_CASE("a scene's hash changes with its file, its archives and its textures, and only then") {
  const TestFolder folder;
  const std::string scene =
      folder.write("s.rib",
                   "Option \"searchpath\" \"texture\" [\"maps:&\"]\nWorldBegin ReadArchive "
                   "\"a.rib\"\nWorldEnd\n");
  folder.write("a.rib", "ReadArchive \"deeper/b.rib\" # \"unused.rib\"\n");
  folder.write("deeper/b.rib", "Surface \"plastic\" \"string texturename\" [\"wood.tex\"]\n");
  folder.write("maps/wood.tex", "wood");
  folder.write("unused.rib", "1");
  const std::string first = hash_scene(scene);
  CHECK(first == hash_scene(scene));

  folder.write("unused.rib", "2");
  CHECK(hash_scene(scene) == first);
  std::set<std::string> hashes{first};
  folder.write("maps/wood.tex", "pine");
  CHECK(hashes.insert(hash_scene(scene)).second);
  folder.write("deeper/b.rib", text_in(folder / "deeper/b.rib") + " ");
  CHECK(hashes.insert(hash_scene(scene)).second);
  folder.write("a.rib", text_in(folder / "a.rib") + " ");
  CHECK(hashes.insert(hash_scene(scene)).second);
  folder.write("s.rib", text_in(scene) + " ");
  CHECK(hashes.insert(hash_scene(scene)).second);
  CHECK_THROWS_AS(hash_scene(folder / "none.rib"), Error);
}

TEST_CASE("archives are followed whatever they are called, and named as something else first") {
  const TestFolder folder;
  const std::string scene = folder.write("s.rib",
                                         "Option \"user\" \"string made_of\" [\"a.inc\"]\n"
                                         "WorldBegin ReadArchive \"a.inc\"\nWorldEnd\n");
  folder.write("a.inc", "ReadArchive \"parts/b\"\n");
  folder.write("parts/b", "Surface \"plastic\" \"string texturename\" [\"wood.tex\"]\n");
  folder.write("parts/wood.tex", "wood");
  std::set<std::string> hashes{hash_scene(scene)};
  folder.write("parts/wood.tex", "pine");
  CHECK(hashes.insert(hash_scene(scene)).second);
  folder.write("parts/b", text_in(folder / "parts/b") + " ");
  CHECK(hashes.insert(hash_scene(scene)).second);
  // One that is found in another place as well may be the one that is read.
  folder.write("wood.tex", "oak");
  CHECK(hashes.insert(hash_scene(scene)).second);
  folder.write("wood.tex", "elm");
  CHECK(hashes.insert(hash_scene(scene)).second);
  CHECK(hashes.count(hash_scene(scene)) == 1);
}

TEST_CASE("archives that name each other end, and what is not RIB has a hash") {
  const TestFolder folder;
  folder.write("a.rib", "ReadArchive \"b.rib\"");
  folder.write("b.rib", "ReadArchive \"a.rib\"");
  CHECK(hash_scene(folder / "a.rib") != hash_scene(folder / "b.rib"));
  folder.write("c.rib", "}{ not RIB");
  CHECK(hash_scene(folder / "c.rib") == hash_file(folder / "c.rib"));
}

TEST_CASE("pixels are told apart by a bit, and not by metadata") {
  Image image(3, 2);
  image.add_channel("R").values[4] = 1.0f;
  Image other = image;
  other.metadata["capDate"] = "today";
  CHECK(hash_pixels(image) == hash_pixels(other));
  other.channels[0].values[0] = -0.0f;
  CHECK(hash_pixels(image) != hash_pixels(other));
}

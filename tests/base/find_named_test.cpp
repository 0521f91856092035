#include <catch2/catch.hpp>

#include "base/find_named.h"

using namespace tessera;

TEST_CASE("entries are found by name, and what there is no entry of names the choices") {
  struct Fruit {
    const char* name;
    int seeds;
  };
  const Fruit table[] = {{"apple", 8}, {"plum", 1}};
  CHECK(&find_named(table, "fruit", "plum") == &table[1]);
  CHECK_THROWS_WITH(find_named(table, "fruit", "plu"),
                    "fruit 'plu' is unknown; expected one of apple, plum");
}

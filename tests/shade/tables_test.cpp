#include <catch2/catch.hpp>

#include <fstream>
#include <sstream>

#include "shade/light.h"
#include "shade/shader.h"

using namespace tessera;

TEST_CASE("channel groups are found by name and unknown ones list the choices") {
  CHECK(find_aov("z").channels == std::vector<std::string>{"Z"});
  CHECK(find_aov("rgb").channels == std::vector<std::string>{"R", "G", "B"});
  CHECK(find_aov("motion").filter == ChannelFilter::closest);
  CHECK_THROWS_WITH(find_aov("rbg"), Catch::Contains("rbg") && Catch::Contains("motion"));
  CHECK(aov_registry().size() == 13);
}

TEST_CASE("the manual names every shader, light, parameter and channel group") {
  std::stringstream text;
  for (const char* page : {"/docs/shaders.md", "/docs/lights.md"}) {
    std::ifstream file(std::string(TESSERA_SOURCE_DIR) + page);
    REQUIRE(file);
    text << file.rdbuf();
  }
  const auto named = [&](const std::string& name) {
    INFO(name);
    CHECK(text.str().find("`" + name + "`") != std::string::npos);
  };
  for (const ShaderDefinition& shader : shader_registry()) {
    named(shader.name);
    for (const std::string& alias : shader.aliases) named(alias);
    for (const ParameterDeclaration& parameter : shader.parameters) named(parameter.name);
  }
  for (const LightDefinition& light : light_registry()) {
    named(light.name);
    for (const ParameterDeclaration& parameter : light.parameters) named(parameter.name);
  }
  for (const AovDefinition& group : aov_registry()) named(group.name);
}

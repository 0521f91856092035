#include <catch2/catch.hpp>

#include "tests/shade/fixtures.h"

using namespace tessera;
using namespace tessera::test;

TEST_CASE("shader names lose their folder and extension") {
  CHECK(shader_stem("plastic") == "plastic");
  CHECK(shader_stem("shaders/surface/plastic.sl") == "plastic");
  CHECK(shader_stem("c:\\shaders\\plastic.slo") == "plastic");
}

TEST_CASE("every registered shader and light can be found and explains itself") {
  for (const ShaderDefinition& shader : shader_registry()) {
    INFO(shader.name);
    CHECK(find_shader(shader.kind, shader.name) == &shader);
    CHECK((shader.kind == ShaderKind::surface ? shader.surface != nullptr
                                              : shader.displace != nullptr));
    CHECK_FALSE(shader.help.empty());
    for (const ParameterDeclaration& parameter : shader.parameters) {
      CHECK_FALSE(parameter.help.empty());
    }
  }
  for (const LightDefinition& light : light_registry()) CHECK(find_light(light.name) == &light);
}

TEST_CASE("instance values replace defaults, and strangers and misfits are reported once and ignored") {
  TestScene test;
  const Surface& surface = test.add_surface(
      "plastic", {number("Kd", 0.25f), number("Kz", 3.0f),
                  triple("Ks", ValueType::color, {1, 1, 1}), number("specularcolor", 0.5f)});
  test.add_surface("plastic", {number("Kz", 3.0f)});
  const auto bindings = test.bind();
  const BoundParameters& parameters = bindings->of(*surface.attributes).surface.parameters;
  CHECK(parameters.scalar("Kd") == 0.25f);
  CHECK(parameters.scalar("Ka") == 1.0f);
  CHECK(parameters.scalar("Ks") == 0.5f);
  CHECK(parameters.vec3("specularcolor") == glm::vec3(1.0f));
  CHECK(test.diagnostics.lines().size() == 3);
  CHECK(test.warned("scene.rib:7: warning: surface shader \"plastic\" has no parameter \"Kz\""));
  CHECK(test.warned("\"Ks\""));
  CHECK(test.warned("\"specularcolor\""));
  CHECK_THROWS_AS(parameters.scalar("roughnes"), std::logic_error);
  CHECK_THROWS_AS(parameters.scalar("specularcolor"), std::logic_error);
}

TEST_CASE("unknown surface shaders warn once with their place and use the default surface") {
  TestScene test;
  const Surface& a = test.add_surface("wobblywood", {number("ringscale", 2.0f)});
  test.add_surface("wobblywood");
  const auto bindings = test.bind();
  CHECK(bindings->of(*a.attributes).surface.definition->name == "defaultsurface");
  REQUIRE(test.diagnostics.lines().size() == 1);
  CHECK_THAT(test.diagnostics.lines()[0],
             Catch::StartsWith("scene.rib:7:") && Catch::Contains("wobblywood"));
}

TEST_CASE("unknown displacements are skipped, and a surface name is no displacement") {
  TestScene test;
  Attributes attributes;
  attributes.displacement = call("plastic");
  test.add_surface(attributes);
  const auto bindings = test.bind();
  CHECK_FALSE(bindings->any_displacement());
  CHECK(make_displacer(bindings) == nullptr);
  CHECK(test.warned("unknown displacement shader \"plastic\""));
}

TEST_CASE("points and vectors of parameters go through shader and camera space") {
  glm::dmat4 camera_from_world(1.0), world_from_shader(1.0);
  camera_from_world[3] = {0, 0, 10, 1};
  world_from_shader[0] = {2, 0, 0, 0};
  world_from_shader[3] = {1, 0, 0, 1};
  TestScene test;
  test.scene.camera.camera_from_world = MovingTransform(camera_from_world);
  test.add_light(
      call("pointlight", {triple("from", ValueType::point, {3, 4, 5})}, world_from_shader));
  Attributes attributes;
  attributes.displacement =
      call("ripple", {triple("direction", ValueType::vector, {1, 1, 0})}, world_from_shader);
  const Surface& surface = test.add_surface(attributes);
  const auto bindings = test.bind();
  const SurfaceBinding& binding = bindings->of(*surface.attributes);
  CHECK(binding.lights.at(0)->parameters.vec3("from") == glm::vec3(7, 4, 15));
  CHECK(binding.displacement->parameters.vec3("direction") == glm::vec3(2, 1, 0));
}

TEST_CASE("normals go through the inverse transpose") {
  glm::dmat4 stretch(1.0);
  stretch[0] = {4, 0, 0, 0};
  CHECK(transformed(stretch, ValueType::normal, {1, 1, 0}) == glm::vec3(0.25f, 1, 0));
  CHECK(transformed(stretch, ValueType::color, {1, 1, 0}) == glm::vec3(1, 1, 0));
}

TEST_CASE("a primitive variable overrides the parameter of its name where the type fits") {
  TestScene test;
  test.add_light(call("ambientlight"));
  const auto grid = make_square(test.add_surface("matte", {number("Ka", 0.5f)}), 2, 3.0f);
  const auto Ka = add_primvar(*grid, "Ka", ValueType::scalar,
                              [](float u, float) { return std::vector<float>{u}; });
  const auto bindings = test.bind();
  SurfaceColors colors = run_surface(*bindings, *grid);
  CHECK(colors.Ci[0].x == 0.0f);
  CHECK(colors.Ci[1].x == 0.5f);
  CHECK(colors.Ci[2].x == 1.0f);
  grid->primvars[0].components = 3;  // as if it were a colour
  grid->primvars[0].values.resize(3 * grid->stride());
  CHECK(run_surface(*bindings, *grid).Ci[0].x == 0.5f);
}

TEST_CASE("which primitive variables a surface wants") {
  TestScene test;
  Attributes attributes;
  attributes.surface = call("marble");
  attributes.displacement = call("dented");
  const Surface& surface = test.add_surface(attributes);
  const auto bindings = test.bind();
  for (const char* name : {"Cs", "Os", "veincolor", "Km", "Pref", "Ka"}) {
    CHECK(wants_primvar(*bindings, *surface.attributes, name));
  }
  CHECK_FALSE(wants_primvar(*bindings, *surface.attributes, "texturename2"));
  CHECK_FALSE(wants_primvar(*bindings, *surface.attributes, "velocity"));
}

TEST_CASE("transparency comes from the attribute, a primitive variable or the shader") {
  const auto transparent = [&](Attributes attributes, bool with_primvar = false) {
    TestScene own;
    Surface& surface = own.add_surface(std::move(attributes));
    if (with_primvar) {
      auto geometry = std::make_shared<Geometry>();
      geometry->primvars.push_back(triple("Os", ValueType::color, {1, 1, 1}));
      surface.geometry = geometry;
    }
    return may_be_transparent(*own.bind(), surface);
  };
  Attributes plain, thin, fading;
  thin.opacity = {1.0f, 0.9f, 1.0f};
  fading.surface = call("fade");
  CHECK_FALSE(transparent(plain));
  CHECK(transparent(thin));
  CHECK(transparent(fading));
  CHECK(transparent(plain, true));
}

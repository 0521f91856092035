#include "shade/bindings.h"

namespace tessera {
namespace {

const LightDefinition* guess_light(const ShaderCall& call) {
  const auto has = [&](const char* name) {
    return find_parameter(call.parameters, name) != nullptr;
  };
  if (has("coneangle")) return find_light("spotlight");
  if (has("from") && has("to")) return find_light("distantlight");
  if (has("from")) return find_light("pointlight");
  return nullptr;
}

}  // namespace

const LightDefinition* choose_light(const ShaderCall& call, Diagnostics& diagnostics) {
  const LightDefinition* known = find_light(shader_stem(call.name));
  if (known) return known;
  const LightDefinition* guess = guess_light(call);
  const std::string instead =
      guess ? fmt::format("judging by its parameters it is taken as a {}", guess->name)
            : std::string("it is left dark");
  diagnostics.warn_once("unknown light " + call.name, call.where,
                        fmt::format("unknown light shader \"{}\"; {}", call.name, instead));
  return guess;
}

const LightDefinition* choose_area_light(const ShaderCall& call, Diagnostics& diagnostics) {
  const LightDefinition* area_light = find_light("arealight");
  if (shader_stem(call.name) != area_light->name) {
    diagnostics.warn_once(
        "area light shader " + call.name, call.where,
        fmt::format("area light shader \"{}\" is taken as an arealight, which shines along the "
                    "outward normals of its surfaces",
                    call.name));
  }
  return area_light;
}

}  // namespace tessera

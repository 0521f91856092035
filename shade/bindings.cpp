#include "shade/bindings.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <stdexcept>

#include "scenes/scene_motion.h"
#include "shade/bounce_radiance.h"
#include "shade/emitter.h"
#include "shade/extended_light.h"
#include "shade/light_shadows.h"

namespace tessera {
namespace {

/// The definition a scene's call means; null, said once, when there is none.
const ShaderDefinition* look_up(ShaderKind kind, const ShaderCall& call, const char* instead,
                                Diagnostics& diagnostics) {
  const ShaderDefinition* found = find_shader(kind, shader_stem(call.name));
  if (!found) {
    diagnostics.warn_once(
        fmt::format("unknown {} shader {}", name_of(kind), call.name), call.where,
        fmt::format("unknown {} shader \"{}\"; {}", name_of(kind), call.name, instead));
  }
  return found;
}

/// Shadow maps mostly lie near the scene file, from wherever it is rendered.
std::vector<std::string> shadow_search_path(const Scene& scene) {
  std::vector<std::string> folders = scene.options.texture_path;
  folders.push_back(std::filesystem::path(scene.file).parent_path().string());
  return folders;
}

/// Whether rays bring the light, rather than take away from it: without them there would be none,
/// so it has no shadows to switch off.
bool is_brought_by_rays(const LightDefinition& definition) {
  return definition.hemisphere && !definition.ambient;
}

/// The places that a light or its map is summed over. Throws Error with the place in the file.
int places_of(const BoundLight& light) {
  try {
    return place_count(light.parameters);
  } catch (const Error& error) {
    throw Error(light.where, fmt::format("light \"{}\": {}", light.definition->name, error.what()));
  }
}

/// Whether some surface belongs to the area light with that index.
bool is_part_of_light(const Scene& scene, int light) {
  return std::ranges::any_of(scene.surfaces, [&](const Surface& surface) {
    return surface.attributes->area_light == light;
  });
}

}  // namespace

std::string_view shader_stem(std::string_view name) {
  if (const size_t slash = name.find_last_of("/\\"); slash != std::string_view::npos) {
    name.remove_prefix(slash + 1);
  }
  return name.substr(0, name.find('.'));
}

ShaderBindings::ShaderBindings(const ShadeSetup& setup)
    : setup_(setup),
      camera_from_world_(setup.camera->camera_from_world(0.0f)),
      textures_(std::make_unique<FrameTextures>(setup.texture_sampler, *setup.diagnostics)),
      shadows_(shadow_search_path(*setup.scene), glm::inverse(camera_from_world_),
               *setup.diagnostics) {
  camera_length_of_world_ =
      float(std::cbrt(std::abs(glm::determinant(glm::dmat3(camera_from_world_)))));
  bind_lights();
  for (const Surface& surface : setup.scene->surfaces) {
    const Attributes& attributes = *surface.attributes;
    if (of_attributes_.contains(&attributes)) continue;
    auto binding = std::make_unique<SurfaceBinding>(
        SurfaceBinding{bind_surface(attributes), bind_displacement(attributes), {}, nullptr});
    for (const int index : attributes.lights) {
      const std::optional<BoundLight>& light = lights_.at(size_t(index));
      if (light) binding->lights.push_back(&*light);
    }
    if (attributes.area_light) {
      const std::optional<BoundLight>& light = lights_.at(size_t(*attributes.area_light));
      if (light) binding->shines = &*light;
    }
    any_displacement_ |= binding->displacement.has_value();
    of_attributes_.emplace(&attributes, binding.get());
    bindings_.push_back(std::move(binding));
  }
}

const SurfaceBinding& ShaderBindings::of(const Attributes& attributes) const {
  const auto found = of_attributes_.find(&attributes);
  if (found == of_attributes_.end()) {
    throw std::logic_error("attributes of a surface that is not in the bound scene");
  }
  return *found->second;
}

ShaderSpaces ShaderBindings::spaces_of(const ShaderCall& call) const {
  ShaderSpaces spaces;
  spaces.camera_from_shader = camera_from_world_ * call.world_from_shader.at(0.0f);
  if (glm::determinant(spaces.camera_from_shader) != 0.0) {
    spaces.shader_from_camera = glm::inverse(spaces.camera_from_shader);
  } else {
    diagnostics().warn_once("singular shader space " + call.name, call.where,
                            fmt::format("the space of shader \"{}\" is singular; its patterns are "
                                        "evaluated in camera space",
                                        call.name));
  }
  return spaces;
}

BoundShader ShaderBindings::bind(ShaderKind kind, const ShaderDefinition& definition,
                                 const ShaderCall& call) const {
  const ShaderSpaces spaces = spaces_of(call);
  const std::string label = fmt::format("{} shader \"{}\"", name_of(kind), definition.name);
  return {&definition, BoundParameters(definition.parameters, call, spaces, label, diagnostics()),
          spaces, glm::inverse(camera_from_world_), call.where};
}

BoundShader ShaderBindings::bind_surface(const Attributes& attributes) const {
  const ShaderDefinition* fallback = find_shader(ShaderKind::surface, "defaultsurface");
  if (!fallback) throw std::logic_error("there is no default surface shader");
  if (!attributes.surface) return bind(ShaderKind::surface, *fallback, ShaderCall{});
  const ShaderDefinition* found = look_up(ShaderKind::surface, *attributes.surface,
                                          "the default surface is used", diagnostics());
  if (found) return bind(ShaderKind::surface, *found, *attributes.surface);
  // The unknown shader's parameters mean nothing to the default one.
  ShaderCall call;
  call.world_from_shader = attributes.surface->world_from_shader;
  call.where = attributes.surface->where;
  return bind(ShaderKind::surface, *fallback, call);
}

std::optional<BoundShader> ShaderBindings::bind_displacement(const Attributes& attributes) const {
  if (!attributes.displacement) return std::nullopt;
  const ShaderDefinition* found = look_up(ShaderKind::displacement, *attributes.displacement,
                                          "the surface is not displaced", diagnostics());
  if (!found) return std::nullopt;
  return bind(ShaderKind::displacement, *found, *attributes.displacement);
}

void ShaderBindings::bind_lights() {
  light_services_ = {.camera = setup_.camera, .textures = textures_.get()};
  lights_.resize(setup_.scene->lights.size());
  for (size_t i = 0; i < lights_.size(); ++i) {
    const Light& light = setup_.scene->lights[i];
    lights_[i] = bind_light(light, int(i));
    if (lights_[i]) bind_shadow(light, *lights_[i]);
  }
}

std::optional<BoundLight> ShaderBindings::bind_light(const Light& light, int index) const {
  const ShaderCall& call = light.shader;
  const LightDefinition* definition =
      light.area ? choose_area_light(call, diagnostics()) : choose_light(call, diagnostics());
  if (!definition) return std::nullopt;
  if (definition == find_light("arealight") && !is_part_of_light(*setup_.scene, index)) {
    throw Error(call.where,
                fmt::format("light \"{}\" can never shine: no surface is part of it. Expected: "
                            "surfaces that follow an AreaLightSource under the same attributes",
                            call.name));
  }
  const ShaderSpaces spaces = spaces_of(call);
  const std::string label = fmt::format("light shader \"{}\"", definition->name);
  BoundLight bound{
      .definition = definition,
      .parameters = BoundParameters(definition->parameters, call, spaces, label, diagnostics()),
      .where = call.where,
      .services = &light_services_,
      .camera_from_light = spaces.camera_from_shader};
  bind_extent(bound);
  return bound;
}

void ShaderBindings::bind_extent(BoundLight& light) const {
  const LightDefinition& definition = *light.definition;
  if (definition.distributed()) light.places = light.open_places = spread_places(places_of(light));
  if (!definition.measure) return;
  try {
    light.extent = definition.measure(light.parameters, light.camera_from_light);
  } catch (const Error& error) {
    throw Error(light.where,
                fmt::format("light \"{}\" can never shine: {}", definition.name, error.what()));
  }
}

TermRate ShaderBindings::rate_of(const ShaderCall& call, const BoundLight& light) const {
  const std::string& name = light.parameters.string("shadowrate");
  // Cells are shaded at shutter open: what moves would cast its shadow from there, sharp and still.
  if (name.empty() && !light.definition->distributed())
    return light.ray_traced && surfaces_move(*setup_.scene) ? TermRate::sample : TermRate::cell;
  try {
    return term_rate(name);
  } catch (const Error& error) {
    diagnostics().warn_once(fmt::format("shadowrate of {}", call.name), call.where,
                            fmt::format("light \"{}\": {}; cell is used", call.name, error.what()));
    return TermRate::cell;
  }
}

void ShaderBindings::bind_shadow(const Light& light, BoundLight& bound) {
  const LightDefinition& definition = *bound.definition;
  if (!definition.transmission && !definition.distributed()) return;
  if (definition.distributed()) {
    bound.ray_traced = light.shadow != "off" || is_brought_by_rays(definition);
  } else if (const std::string& map = bound.parameters.string("shadowname"); !map.empty()) {
    bound.ray_traced = map == ray_traced_name;
    if (!bound.ray_traced) {
      places_of(bound);  // throws where there is no such number
      bound.shadow = &shadows_.source(map, light.shader.where);
    }
  } else {
    bound.ray_traced = light.shadow == "on";
  }
  bound.rate = rate_of(light.shader, bound);
  // Light from an extent varies with the place on it even if nothing is in the way.
  const bool varies = bound.casts_shadows() || definition.illuminate_from;
  if (!varies || bound.rate == TermRate::cell) return;
  bound.term = term_count_++;
  term_lights_.push_back(&bound);
  if (!definition.illuminate_from) return;
  bound.mean_term = term_count_++;
  // Each sample adds a place to what the light brings, cells the rest: these can be many.
  bound.open_places = spread_places(term_places_scale * places_of(bound));
}

void ShaderBindings::use_rays(std::shared_ptr<const RayTracer> rays) {
  rays_ = std::move(rays);
  bounce_ = rays_ ? std::make_shared<const BounceRadiance>(*this, *rays_) : nullptr;
  light_services_.rays = rays_.get();
  light_services_.bounce = bounce_.get();
}

void ShaderBindings::use_emitters(std::span<const std::shared_ptr<const Grid>> grids) {
  for (size_t i = 0; i < lights_.size(); ++i) {
    if (lights_[i] && setup_.scene->lights[i].area) make_emitter(grids, int(i), *lights_[i]);
  }
}

bool ShaderBindings::wants_emitters() const {
  for (size_t i = 0; i < lights_.size(); ++i)
    if (lights_[i] && setup_.scene->lights[i].area) return true;
  return false;
}

bool ShaderBindings::wants_rays() const {
  return std::ranges::any_of(lights_, [](const auto& light) { return light && light->ray_traced; });
}

bool ShaderBindings::has_effect(RayEffect effect) const {
  return std::ranges::any_of(term_lights_, [&](const BoundLight* light) {
    return light->definition->distributed() && light->definition->effect == effect;
  });
}

std::shared_ptr<ShaderBindings> bind_shaders(const ShadeSetup& setup) {
  return std::make_shared<ShaderBindings>(setup);
}

bool wants_rays(const ShaderBindings& bindings) { return bindings.wants_rays(); }

bool wants_emitters(const ShaderBindings& bindings) { return bindings.wants_emitters(); }

bool has_effect(const ShaderBindings& bindings, RayEffect effect) {
  return bindings.has_effect(effect);
}

void use_emitters(ShaderBindings& bindings, std::span<const std::shared_ptr<const Grid>> grids) {
  bindings.use_emitters(grids);
}

void use_rays(ShaderBindings& bindings, std::shared_ptr<const RayTracer> rays) {
  bindings.use_rays(std::move(rays));
}

size_t bounce_bytes(const ShaderBindings& bindings) {
  return bindings.bounce() ? bindings.bounce()->memory_bytes() : 0;
}

bool may_be_transparent(const ShaderBindings& bindings, const Surface& surface) {
  const glm::vec3& opacity = surface.attributes->opacity;
  if (!(opacity.x >= 1.0f && opacity.y >= 1.0f && opacity.z >= 1.0f)) return true;
  if (find_parameter(surface.geometry->primvars, "Os")) return true;
  return bindings.of(*surface.attributes).surface.definition->sets_opacity;
}

bool wants_primvar(const ShaderBindings& bindings, const Attributes& attributes,
                   std::string_view name) {
  if (name == "Cs" || name == "Os") return true;
  const auto reads = [&](const BoundShader& shader) {
    return shader.parameters.find(name) >= 0 ||
           std::ranges::count(shader.definition->primvars, name) > 0;
  };
  const SurfaceBinding& binding = bindings.of(attributes);
  return reads(binding.surface) || (binding.displacement && reads(*binding.displacement));
}

}  // namespace tessera

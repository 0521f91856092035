#pragma once
/// The shaders, lights and textures of a scene, looked up and given their parameters once a frame.

#include <map>
#include <memory>
#include <optional>
#include <unordered_map>
#include <vector>

#include "shade/shade.h"
#include "shade/shader.h"
#include "shade/shadow_source.h"
#include "shade/textures.h"

namespace tessera {

/// A shader with the parameters of one call.
struct BoundShader {
  const ShaderDefinition* definition = nullptr;
  BoundParameters parameters;
  ShaderSpaces spaces;
  glm::dmat4 world_from_camera{1.0};
  SourceLocation where;
};

/// Everything that shades the surfaces under one Attributes.
struct SurfaceBinding {
  BoundShader surface;
  std::optional<BoundShader> displacement;
  std::vector<const BoundLight*> lights;
  const BoundLight* shines = nullptr;  ///< the area light that the surface is part of, if any
};

/// Immutable once made, and thread safe.
class ShaderBindings {
 public:
  /// Binds what every surface of setup.scene calls. Spaces are those at shutter open.
  explicit ShaderBindings(const ShadeSetup& setup);
  ShaderBindings(const ShaderBindings&) = delete;
  ShaderBindings& operator=(const ShaderBindings&) = delete;

  /// `attributes` belongs to a surface of the scene.
  const SurfaceBinding& of(const Attributes& attributes) const;
  bool any_displacement() const { return any_displacement_; }
  const Camera& camera() const { return *setup_.camera; }
  Diagnostics& diagnostics() const { return *setup_.diagnostics; }
  FrameTextures& textures() const { return *textures_; }
  /// Size of SurfaceColors::light_terms.
  size_t light_term_count() const { return term_count_; }
  /// Lights of the scene whose shadows are looked up at a rate of their own.
  std::span<const BoundLight* const> term_lights() const { return term_lights_; }
  /// Before the first point is shaded: the grids of the surfaces that area lights shine from.
  /// Throws Error, with the place in the scene file, where a light has no area.
  void use_emitters(std::span<const std::shared_ptr<const Grid>> grids);
  bool wants_emitters() const;
  /// Before the first point is shaded.
  void use_rays(std::shared_ptr<const RayTracer> rays);
  /// Null: there are none.
  const RayTracer* rays() const { return rays_.get(); }
  bool wants_rays() const;
  /// Whether samples of lights of that effect are rays of each sample's own.
  bool has_effect(RayEffect effect) const;
  /// What lights may call on; without counters.
  const LightServices& light_services() const { return light_services_; }
  /// What rays find on surfaces; null without rays.
  const BounceRadiance* bounce() const { return bounce_.get(); }
  /// Camera units in one world unit.
  float camera_length_of_world() const { return camera_length_of_world_; }

 private:
  BoundShader bind(ShaderKind kind, const ShaderDefinition& definition,
                   const ShaderCall& call) const;
  BoundShader bind_surface(const Attributes& attributes) const;
  std::optional<BoundShader> bind_displacement(const Attributes& attributes) const;
  void bind_lights();
  std::optional<BoundLight> bind_light(const Light& light, int index) const;
  void bind_extent(BoundLight& light) const;
  void bind_shadow(const Light& light, BoundLight& bound);
  TermRate rate_of(const ShaderCall& call, const BoundLight& light) const;
  ShaderSpaces spaces_of(const ShaderCall& call) const;

  ShadeSetup setup_;
  glm::dmat4 camera_from_world_{1.0};
  float camera_length_of_world_ = 1.0f;
  bool any_displacement_ = false;
  std::unique_ptr<FrameTextures> textures_;
  FrameShadows shadows_;
  std::shared_ptr<const RayTracer> rays_;
  LightServices light_services_;
  std::shared_ptr<const BounceRadiance> bounce_;
  std::vector<std::optional<BoundLight>> lights_;  ///< as Scene::lights; empty: does not shine
  std::vector<const BoundLight*> term_lights_;
  size_t term_count_ = 0;
  std::vector<std::unique_ptr<SurfaceBinding>> bindings_;  ///< in the order surfaces need them
  std::unordered_map<const Attributes*, const SurfaceBinding*> of_attributes_;  ///< look-up only
};

/// A shader's plain name: "shaders/plastic.sl" gives "plastic".
std::string_view shader_stem(std::string_view name);

/// The definition a scene's light means: by name or, when unknown, guessed from the parameters it
/// is given (coneangle: spotlight; from and to: distantlight; from: pointlight). Null: no guess.
/// Whatever is not exact is said once.
const LightDefinition* choose_light(const ShaderCall& call, Diagnostics& diagnostics);

/// The definition that an area light of the scene means, whatever its name, which is said once if
/// it is not that of an area light.
const LightDefinition* choose_area_light(const ShaderCall& call, Diagnostics& diagnostics);

}  // namespace tessera

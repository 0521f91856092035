#pragma once
/// Surface and displacement shaders: functions over batches of points, one file of shade/shaders/
/// each. docs/shaders.md lists them and shows how to write one.

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "shade/illumination.h"
#include "shade/parameters.h"
#include "shade/pattern_points.h"
#include "shade/points.h"
#include "shade/shade.h"

namespace tessera {

class FrameTextures;
class ShaderContext;
struct BoundShader;

enum class ShaderKind { surface, displacement };
const char* name_of(ShaderKind kind);

/// What a surface shader computes, one entry a point, linear. It arrives sized and zeroed.
struct SurfaceColors {
  Vec3Array Ci;  ///< colour sent towards the eye, already multiplied by Oi
  Vec3Array Oi;  ///< opacity
  /// [term] What a light whose shadows are looked up at a rate of their own would add to Ci if
  /// nothing shadowed it, or its diffuse light alone (BoundLight::term, mean_term). As many as
  /// ShaderBindings::light_term_count().
  std::vector<Vec3Array> light_terms{};
};

struct ShaderDefinition {
  std::string name{};
  std::vector<std::string> aliases{};  ///< other names it answers to
  std::string help{};
  ShaderKind kind = ShaderKind::surface;
  std::vector<ParameterDeclaration> parameters{};
  /// Primitive variables read besides Cs, Os and those that override a parameter of their name.
  std::vector<std::string> primvars{};
  bool sets_opacity = false;  ///< Oi may differ from Os
  void (*surface)(const ShaderContext& context, SurfaceColors& out) = nullptr;
  /// Writes signed distances along the normal, world units. Only P, N, st and primitive variables
  /// may enter, which neighbouring grids share on their common edge; footprints may not.
  void (*displace)(const ShaderContext& context, std::span<float> distance) = nullptr;
};

std::span<const ShaderDefinition> shader_registry();
/// The shader of that kind called `name` or with that alias, or null.
const ShaderDefinition* find_shader(ShaderKind kind, std::string_view name);

/// What a shader may call on besides its points.
struct ShaderServices {
  std::span<const BoundLight* const> lights{};
  FrameTextures* textures = nullptr;
  ShadeCounters* counters = nullptr;
  /// Whether only light is wanted that the surface sends out alike in all directions: highlights
  /// and reflections are zero then.
  bool diffuse_only = false;
};

/// Directions and how they differ within each point's shading cell, camera space.
struct CellDirections {
  Vec3Array direction;           ///< unit
  Vec3Array dx, dy;              ///< change over the cell along its two axes
  AlignedVector<float> scatter;  ///< variance besides, radians^2 in each tangential direction
};

/// One run of one shader over one batch.
class ShaderContext {
 public:
  /// The arguments must outlive the context.
  ShaderContext(const BoundShader& shader, const ShadingPoints& points,
                const ShaderServices& services);

  const ShadingPoints& points() const { return points_; }
  int count() const { return points_.count; }

  /// Parameters by name: a primitive variable of the same name and size overrides the value the
  /// scene gave. Throw std::logic_error for a name that the shader does not declare.
  ScalarInput scalar(std::string_view name) const;
  Vec3Input vec3(std::string_view name) const;
  const std::string& string(std::string_view name) const;

  /// Unit normals turned towards the eye (faceforward of the RenderMan Interface).
  Vec3Array facing_normals() const;

  /// Calls color(light, i) for every point i: with the lights that have no term of their own taken
  /// together, which is added to out.Ci, and with each of the others, unshadowed, for its
  /// out.light_terms. So `color` returns what `light` adds to Ci and nothing else: it is linear in
  /// the light, and zero without any. A null roughness gives no specular sums.
  template <class Color>
  void shade_lights(const Vec3Array& N, const ScalarInput* roughness, SurfaceColors& out,
                    const Color& color) const {
    const Illumination together = gather_together(N, roughness);
    for (int i = 0; i < count(); ++i) out.Ci.add(i, color(together, i));
    for (const BoundLight* light : services_.lights) {
      if (!light->term) continue;
      const Illumination alone = gather_alone(*light, N, roughness);
      Vec3Array& term = out.light_terms.at(*light->term);
      for (int i = 0; i < count(); ++i) term.set(i, color(alone, i));
      if (light->mean_term) out.light_terms.at(*light->mean_term) = alone.diffuse;
    }
  }

  /// The texture `file` at the points' own st, filtered over their footprints; magenta when the
  /// file is missing.
  Vec3Array texture(const std::string& file) const;
  /// Mirror directions of the view about the unit normals `N`, which are points().N or opposite.
  CellDirections mirror_directions(const Vec3Array& N) const;
  /// The latitude-longitude environment map `file` in the world directions of `directions`, blurred
  /// over their cells and over `blur` radians. Longitude 0 is world +x, z is up.
  Vec3Array environment(const std::string& file, const CellDirections& directions,
                        const ScalarInput& blur) const;

  /// Points in shader space: the primitive variable Pref where there is one, so that patterns stick
  /// to a deforming surface, otherwise P. List "Pref" in ShaderDefinition::primvars.
  PatternPoints pattern_points() const;
  /// `vector_camera` in shader space.
  glm::vec3 shader_vector(const glm::vec3& vector_camera) const;

 private:
  Illumination gather_from(std::span<const BoundLight* const> lights, const Vec3Array& N,
                           const ScalarInput* roughness, Shadows shadows) const;
  Illumination gather_together(const Vec3Array& N, const ScalarInput* roughness) const;
  Illumination gather_alone(const BoundLight& light, const Vec3Array& N,
                            const ScalarInput* roughness) const;

  /// One declared parameter after overriding.
  struct Value {
    const float* values;
    size_t stride;  ///< between components; 1 when uniform
    int step;
  };
  const BoundShader& shader_;
  const ShadingPoints& points_;
  ShaderServices services_;
  std::vector<Value> values_;             ///< [parameter]
  std::vector<Vec3Array> camera_values_;  ///< overriding points and vectors, in camera space
};

}  // namespace tessera

#include "shade/aov.h"

#include <cmath>

namespace tessera {
namespace {

void put(const glm::vec3& v, float* out) { out[0] = v.x, out[1] = v.y, out[2] = v.z; }

void color_of(const CompositedSample& sample, float* out) { put(sample.color, out); }
void indirect_of(const CompositedSample& sample, float* out) { put(sample.indirect, out); }
void direct_of(const CompositedSample& sample, float* out) {
  put(sample.color - sample.indirect, out);
}
void opacity_of(const CompositedSample& sample, float* out) { put(sample.opacity, out); }
void alpha_of(const CompositedSample& sample, float* out) {
  out[0] = (sample.opacity.x + sample.opacity.y + sample.opacity.z) / 3.0f;
}

void depth_of(const AovInput& input, size_t fragment, float* out) {
  out[0] = input.bucket.fragments->z[fragment];
}

void position_of(const AovInput& input, size_t fragment, float* out) {
  const FragmentGeometry seen(input.bucket, fragment);
  put(seen.P_camera(seen.time), out);
}

void normal_of(const AovInput& input, size_t fragment, float* out) {
  put(unit_normal(FragmentGeometry(input.bucket, fragment)), out);
}

void st_of(const AovInput& input, size_t fragment, float* out) {
  const FragmentGeometry seen(input.bucket, fragment);
  const float* st = seen.grid->st.data();
  out[0] = seen.interpolate(st);
  out[1] = seen.interpolate(st + seen.grid->stride());
}

void motion_of(const AovInput& input, size_t fragment, float* out) {
  const glm::vec2 shift = raster_motion(FragmentGeometry(input.bucket, fragment), input.camera);
  out[0] = shift.x, out[1] = shift.y;
}

void id_of(const AovInput& input, size_t fragment, float* out) {
  out[0] = float(input.bucket.grids[input.bucket.fragments->grid[fragment]]->id.surface + 1);
}

/// A colour for each cell, so that neighbours can be told apart.
void cell_of(const AovInput& input, size_t fragment, float* out) {
  uint32_t hash = input.shaded.cell[fragment];
  for (int c = 0; c < 3; ++c, hash >>= 8) out[c] = 0.1f + 0.9f * float(hash & 255) / 255.0f;
}

/// Depth where nothing is seen: RI_INFINITY of the RenderMan Interface.
constexpr float infinite_depth = 1e38f;

constexpr ChannelFilter filtered = ChannelFilter::filtered, closest = ChannelFilter::closest;

std::span<const AovEvaluator> evaluators() {
  static const AovEvaluator table[] = {
      {{"rgb", "colour", {"R", "G", "B"}, filtered, 0.0f}, color_of, nullptr},
      {{"a", "alpha: mean of the three opacities", {"A"}, filtered, 0.0f}, alpha_of, nullptr},
      {{"z", "camera depth", {"Z"}, closest, infinite_depth}, nullptr, depth_of},
      {{"Ci", "colour, as a group of its own", {"Ci.R", "Ci.G", "Ci.B"}, filtered, 0.0f},
       color_of,
       nullptr},
      {{"Oi", "opacity", {"Oi.R", "Oi.G", "Oi.B"}, filtered, 0.0f}, opacity_of, nullptr},
      {{"direct",
        "colour without what other surfaces brought",
        {"direct.R", "direct.G", "direct.B"},
        filtered,
        0.0f},
       direct_of,
       nullptr},
      {{"indirect",
        "colour that other surfaces brought, by lights with a shadowrate of pixel or sample",
        {"indirect.R", "indirect.G", "indirect.B"},
        filtered,
        0.0f},
       indirect_of,
       nullptr},
      {{"P", "position in camera space, when seen", {"P.x", "P.y", "P.z"}, closest, 0.0f},
       nullptr,
       position_of},
      {{"N", "unit normal in camera space at shutter open", {"N.x", "N.y", "N.z"}, closest, 0.0f},
       nullptr,
       normal_of},
      {{"st", "texture coordinates", {"st.x", "st.y"}, closest, 0.0f}, nullptr, st_of},
      {{"motion",
        "raster displacement from shutter open to close, pixels",
        {"motion.x", "motion.y"},
        closest,
        0.0f},
       nullptr,
       motion_of},
      {{"id", "number of the surface in scene order, from 1", {"id"}, closest, 0.0f},
       nullptr,
       id_of},
      {{"cell",
        "a colour for each shading cell, as they lie at shutter open",
        {"cell.R", "cell.G", "cell.B"},
        closest,
        0.0f,
        true},
       nullptr,
       cell_of,
       true},
  };
  return table;
}

}  // namespace

glm::vec2 raster_motion(const FragmentGeometry& seen, const Camera& camera) {
  if (seen.grid->key_count() < 2) return glm::vec2(0.0f);
  const glm::vec3 open = camera.raster_clip_from_camera(seen.P_camera(0.0f));
  const glm::vec3 close = camera.raster_clip_from_camera(seen.P_camera(1.0f));
  // At or behind the eye there is no place on the raster.
  if (!(open.z > 0.0f && close.z > 0.0f)) return glm::vec2(0.0f);
  const glm::vec2 shift(close.x / close.z - open.x / open.z, close.y / close.z - open.y / open.z);
  const bool finite = std::isfinite(shift.x) && std::isfinite(shift.y);
  return finite ? shift : glm::vec2(0.0f);
}

const AovEvaluator& evaluator_of(const AovDefinition& definition) {
  const std::string_view name = definition.name;
  for (const AovEvaluator& evaluator : evaluators()) {
    if (evaluator.definition.name == name) return evaluator;
  }
  throw Error(fmt::format("no channel group is called \"{}\"", name));
}

std::span<const AovDefinition> aov_registry() {
  static const std::vector<AovDefinition> table = [] {
    std::vector<AovDefinition> definitions;
    for (const AovEvaluator& evaluator : evaluators()) definitions.push_back(evaluator.definition);
    return definitions;
  }();
  return table;
}

const AovDefinition& find_aov(std::string_view name) {
  std::string choices;
  for (const AovDefinition& definition : aov_registry()) {
    if (definition.name == name) return definition;
    choices += fmt::format("{}{}", choices.empty() ? "" : ", ", definition.name);
  }
  throw Error(fmt::format("unknown channel group \"{}\"; expected one of: {}", name, choices));
}

}  // namespace tessera

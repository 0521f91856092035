#include "shade/shadow_map.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

#include "base/error.h"
#include "base/hash.h"

namespace tessera {
namespace {

const Image::Channel& depth_channel(const Image& image) {
  if (const Image::Channel* z = image.find_channel("Z")) return *z;
  if (image.channels.size() == 1) return image.channels.front();
  throw Error("expected a channel Z or a single channel, found neither");
}

/// For column vectors.
glm::dmat4 matrix(const Image& image, const char* name) {
  const auto found = image.matrices.find(name);
  if (found == image.matrices.end()) {
    throw Error(fmt::format("expected a matrix \"{}\" of the camera it was rendered with", name));
  }
  glm::dmat4 result;
  for (int i = 0; i < 16; ++i) {
    const float value = found->second[size_t(i)];
    if (!std::isfinite(value)) throw Error(fmt::format("matrix \"{}\" is not finite", name));
    result[i / 4][i % 4] = double(value);
  }
  return result;
}

/// Rounding of float positions and matrices, in units of the terms that make up a depth.
constexpr double rounding = 4e-6;

/// Points of the unit cube [-1/2, 1/2)^4, evenly spread for any count: strata in the first
/// coordinate, additive recurrences in the others (the golden ratio makes the first two a Fibonacci
/// lattice; the last two are those of M. Roberts, "The unreasonable effectiveness of quasirandom
/// sequences", 2018). Each point of a surface shifts them its own way, so that few samples give
/// noise rather than bands.
class FilterPlaces {
 public:
  FilterPlaces(int count, const glm::vec3& P) : count_(count) {
    uint32_t seed = 0;
    for (int axis = 0; axis < 3; ++axis) {
      seed = hash_combine(seed, std::bit_cast<uint32_t>(P[axis]));
    }
    for (double& shift : shift_) shift = double(seed = mix32(seed + 1)) * 0x1p-32;
  }
  std::array<double, 4> operator[](int k) const {
    const std::array<double, 4> place{(k + 0.5) / count_, k * 0.6180339887498949,
                                      k * 0.7548776662466927, k * 0.5698402909980532};
    std::array<double, 4> result;
    for (size_t d = 0; d < 4; ++d) {
      const double x = place[d] + shift_[d];
      result[d] = x - std::floor(x) - 0.5;
    }
    return result;
  }

 private:
  int count_;
  std::array<double, 4> shift_;
};

/// Two vectors that span the plane with normal `n`.
std::array<glm::dvec3, 2> plane_axes(const glm::dvec3& n) {
  const glm::dvec3 axis = std::abs(n.x) < 0.6 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
  const glm::dvec3 across = glm::cross(n, axis);
  return {across, glm::cross(n, across)};
}

}  // namespace

ShadowMap::ShadowMap(const Image& depth)
    : frame_(depth.display_window), held_(depth.data_window), depth_(depth_channel(depth).values) {
  if (frame_.empty() || held_.empty()) throw Error("it has no pixels");
  read_matrices(depth);
}

void ShadowMap::read_matrices(const Image& depth) {
  // The columns of the transposed matrices are rows of the maps.
  const glm::dmat4 camera = glm::transpose(matrix(depth, "worldToCamera"));
  const glm::dmat4 ndc = glm::transpose(matrix(depth, "worldToNDC"));
  depth_row_ = camera[2], w_row_ = ndc[3];
  x_row_ = double(frame_.width()) * ndc[0] + double(frame_.x0) * w_row_;
  y_row_ = double(frame_.height()) * ndc[1] + double(frame_.y0) * w_row_;

  const glm::dvec3 view(depth_row_);
  const double depth_scale = glm::length(view);
  perspective_ = glm::length(glm::dvec3(w_row_)) > 0.0;
  // w is a multiple of depth, or constant: scaled, it is depth, or 1.
  const double scale =
      perspective_ ? glm::dot(glm::dvec3(w_row_), view) / glm::dot(view, view) : w_row_.w;
  const glm::dvec4 expected = perspective_ ? scale * depth_row_ : w_row_;
  if (!(depth_scale > 0.0 && scale > 0.0 &&
        glm::length(w_row_ - expected) <= 1e-3 * glm::length(w_row_))) {
    throw Error("matrices \"worldToCamera\" and \"worldToNDC\" are not those of one camera");
  }
  x_row_ /= scale, y_row_ /= scale, w_row_ /= scale;
  if (perspective_) w_row_ = depth_row_;
  const auto pixels_per_unit = [&](const glm::dvec4& row) {
    const glm::dvec3 v(row), unit_view = view / depth_scale;
    return glm::length(v - glm::dot(v, unit_view) * unit_view) / depth_scale;
  };
  texel_ = 1.0 / std::min(pixels_per_unit(x_row_), pixels_per_unit(y_row_));
  if (!std::isfinite(texel_)) throw Error("matrix \"worldToNDC\" is singular");
}

bool ShadowMap::receive(const glm::dvec3& P_world, double bias, Receiver& receiver) const {
  const glm::dvec4 P(P_world, 1.0);
  const double w = glm::dot(w_row_, P), depth = glm::dot(depth_row_, P);
  if (!(w > 0.0)) return false;
  receiver.w = w;
  receiver.raster = glm::dvec2(glm::dot(x_row_, P), glm::dot(y_row_, P)) / w;
  receiver.nearness = perspective_ ? 1.0 / depth : -depth;
  const double terms = glm::dot(glm::abs(depth_row_), glm::abs(P));
  receiver.allowance = bias + texel_ * w + rounding * terms;
  return true;
}

ShadowMap::Change ShadowMap::change(const Receiver& receiver, const glm::dvec3& along) const {
  const glm::dvec4 D(along, 0.0);
  const double w = receiver.w;
  const glm::dvec2 homogeneous(glm::dot(x_row_, D), glm::dot(y_row_, D));
  const glm::dvec2 raster = (homogeneous - receiver.raster * glm::dot(w_row_, D)) / w;
  const double depth_change = glm::dot(depth_row_, D);
  return {raster, perspective_ ? -depth_change / (w * w) : -depth_change};
}

/// Sets how nearness changes over the plane that the two vectors span.
void ShadowMap::tilt(const glm::dvec3& across, const glm::dvec3& along, Receiver& receiver) const {
  const Change a = change(receiver, across), b = change(receiver, along);
  const double area = a.raster.x * b.raster.y - a.raster.y * b.raster.x;
  // Edge on, where the light does not shine on the plane, there is no slope to speak of.
  if (!(std::abs(area) > 1e-6 * glm::length(a.raster) * glm::length(b.raster))) return;
  receiver.nearness_slope = glm::dvec2(a.nearness * b.raster.y - b.nearness * a.raster.y,
                                       b.nearness * a.raster.x - a.nearness * b.raster.x) /
                            area;
}

/// Whether what the texel holds is nearer than the receiver anywhere in it.
bool ShadowMap::blocked(int x, int y, const Receiver& receiver) const {
  if (!held_.contains(x, y)) return false;
  const glm::dvec2 away = glm::dvec2(x + 0.5, y + 0.5) - receiver.raster;
  const glm::dvec2 slope = receiver.nearness_slope;
  const double nearness =
      receiver.nearness + glm::dot(slope, away) + 0.5 * (std::abs(slope.x) + std::abs(slope.y));
  if (perspective_ && nearness <= 0.0) return false;  // the plane lies beyond its horizon there
  const double depth = perspective_ ? 1.0 / nearness : -nearness;
  const size_t index = size_t(y - held_.y0) * size_t(held_.width()) + size_t(x - held_.x0);
  return double(depth_[index]) < depth - receiver.allowance;
}

/// The four texels around `raster`, interpolated: continuous in the place, so that a hard edge is a
/// ramp one texel wide.
double ShadowMap::lit_around(const glm::dvec2& raster, const Receiver& receiver) const {
  const glm::dvec2 corner = raster - 0.5;
  if (!(corner.x > held_.x0 - 1.0 && corner.x < held_.x1 && corner.y > held_.y0 - 1.0 &&
        corner.y < held_.y1)) {
    return 1.0;
  }
  const int x = int(std::floor(corner.x)), y = int(std::floor(corner.y));
  const double fx = corner.x - x, fy = corner.y - y;
  const auto lit = [&](int dx, int dy) { return blocked(x + dx, y + dy, receiver) ? 0.0 : 1.0; };
  return (1.0 - fy) * ((1.0 - fx) * lit(0, 0) + fx * lit(1, 0)) +
         fy * ((1.0 - fx) * lit(0, 1) + fx * lit(1, 1));
}

void ShadowMap::light_share(const ShadingPoints& points, const glm::dmat4& world_from_camera,
                            const ShadowFilter& filter, std::span<float> share) const {
  const glm::dmat3 turn(world_from_camera);
  const glm::dvec2 blur = double(filter.blur) * glm::dvec2(frame_.width(), frame_.height());
  const bool spread_by_cell = points.dPdx.x && filter.width > 0.0f;
  const bool spread = spread_by_cell || filter.blur > 0.0f;
  for (int i = 0; i < points.count; ++i) {
    const glm::dvec3 P(world_from_camera * glm::dvec4(points.P[i], 1.0));
    Receiver receiver;
    share[size_t(i)] = 1.0f;
    if (!receive(P, double(filter.bias), receiver)) continue;
    const auto [across, along] = plane_axes(glm::dvec3(points.N[i]));
    tilt(turn * across, turn * along, receiver);
    if (!spread) {
      share[size_t(i)] = float(lit_around(receiver.raster, receiver));
      continue;
    }
    glm::dvec2 x_axis(0.0), y_axis(0.0);
    if (spread_by_cell) {
      x_axis = double(filter.width) * change(receiver, turn * glm::dvec3(points.dPdx[i])).raster;
      y_axis = double(filter.width) * change(receiver, turn * glm::dvec3(points.dPdy[i])).raster;
    }
    const int samples = std::max(1, filter.samples);
    const FilterPlaces places(samples, points.P[i]);
    double lit = 0.0;
    for (int k = 0; k < samples; ++k) {
      const auto [a, b, c, d] = places[k];
      // The first two coordinates are the better ones, and blur is mostly wider than a cell.
      const glm::dvec2 offset = filter.blur > 0.0f
                                    ? glm::dvec2(a, b) * blur + c * x_axis + d * y_axis
                                    : a * x_axis + b * y_axis;
      lit += lit_around(receiver.raster + offset, receiver);
    }
    share[size_t(i)] = float(lit / samples);
  }
}

}  // namespace tessera

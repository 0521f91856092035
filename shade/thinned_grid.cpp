#include "shade/thinned_grid.h"

#include <algorithm>

namespace tessera {
namespace {

/// 0, step, 2 step, ..., and `last`.
std::vector<int> kept(int last, int step) {
  std::vector<int> indices;
  for (int k = 0; k < last; k += step) indices.push_back(k);
  indices.push_back(last);
  return indices;
}

/// Where an index lies among those kept: between place and place + 1.
struct Between {
  int place;
  float share;  ///< of place + 1
};

std::vector<Between> places(const std::vector<int>& indices) {
  std::vector<Between> result;
  for (int place = 0; place + 1 < int(indices.size()); ++place) {
    const int first = indices[size_t(place)], next = indices[size_t(place) + 1];
    for (int k = first; k < next; ++k)
      result.push_back({place, float(k - first) / float(next - first)});
  }
  result.push_back({int(indices.size()) - 2, 1.0f});
  return result;
}

}  // namespace

ThinnedGrid::ThinnedGrid(const Grid& grid, int step)
    : columns_(kept(grid.u_count, step)), rows_(kept(grid.v_count, step)) {
  thin_.id = grid.id, thin_.surface = grid.surface;
  thin_.u_count = int(columns_.size()) - 1, thin_.v_count = int(rows_.size()) - 1;
  thin_.normal_sign = grid.normal_sign, thin_.one_sided = grid.one_sided;
  const size_t stride = grid.stride(), thin_stride = thin_.stride();
  const auto copy = [&](const AlignedVector<float>& from, size_t components) {
    AlignedVector<float> to(components * thin_stride);
    for (size_t c = 0; c < components; ++c) {
      float* out = to.data() + c * thin_stride;
      for (const int row : rows_)
        for (const int column : columns_)
          *out++ = from[c * stride + size_t(row * (grid.u_count + 1) + column)];
    }
    return to;
  };
  thin_.P_camera = copy(grid.P_camera, 3);
  thin_.N_camera = copy(grid.N_camera, 3);
  thin_.uv = copy(grid.uv, 2), thin_.st = copy(grid.st, 2);
  for (const GridPrimvar& primvar : grid.primvars)
    thin_.primvars.push_back(
        {primvar.source, primvar.components, copy(primvar.values, size_t(primvar.components))});
}

std::vector<glm::vec3> ThinnedGrid::spread(std::span<const glm::vec3> values) const {
  const std::vector<Between> along_u = places(columns_), along_v = places(rows_);
  const size_t row = columns_.size();
  std::vector<glm::vec3> result;
  result.reserve(along_u.size() * along_v.size());
  for (const Between& v : along_v) {
    const glm::vec3* lower = values.data() + size_t(v.place) * row;
    for (const Between& u : along_u) {
      const glm::vec3 *a = lower + u.place, *b = a + row;
      result.push_back(
          glm::mix(glm::mix(a[0], a[1], u.share), glm::mix(b[0], b[1], u.share), v.share));
    }
  }
  return result;
}

}  // namespace tessera

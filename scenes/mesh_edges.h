#pragma once
/// The edges of a mesh, for checks.

#include <algorithm>
#include <utility>
#include <vector>

namespace tessera {

/// The set of undirected edges of a face-vertex mesh whose counts have been checked.
class MeshEdges {
 public:
  MeshEdges(const std::vector<int>& face_vertex_counts, const std::vector<int>& face_vertices) {
    edges_.reserve(face_vertices.size());
    size_t first = 0;
    for (int count : face_vertex_counts) {
      for (int i = 0; i < count; ++i)
        edges_.push_back(
            key(face_vertices[first + size_t(i)], face_vertices[first + size_t((i + 1) % count)]));
      first += size_t(count);
    }
    std::sort(edges_.begin(), edges_.end());
  }

  bool contains(int v0, int v1) const {
    return std::binary_search(edges_.begin(), edges_.end(), key(v0, v1));
  }

 private:
  static std::pair<int, int> key(int v0, int v1) { return std::minmax(v0, v1); }

  std::vector<std::pair<int, int>> edges_;
};

}  // namespace tessera

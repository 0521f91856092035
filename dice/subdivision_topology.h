#pragma once
/// OpenSubdiv's view of a control mesh, and which face speaks for each of its edges and vertices.

#include <memory>
#include <mutex>
#include <shared_mutex>
#include <vector>

#include <opensubdiv/bfr/refinerSurfaceFactory.h>
#include <opensubdiv/bfr/surface.h>
#include <opensubdiv/far/topologyRefiner.h>

#include "dice/patch.h"
#include "scenes/geometry.h"

namespace tessera {

class SubdivisionTopology {
 public:
  using Cache = OpenSubdiv::Bfr::SurfaceFactoryCacheThreaded<
      std::shared_mutex, std::shared_lock<std::shared_mutex>, std::unique_lock<std::shared_mutex>>;
  using Factory = OpenSubdiv::Bfr::RefinerSurfaceFactory<Cache>;
  using BfrSurface = OpenSubdiv::Bfr::Surface<float>;

  explicit SubdivisionTopology(const Geometry& geometry);

  uint32_t patch_count() const { return first_patch_.back(); }
  int face_of(uint32_t patch) const;
  int face_size(int face) const { return level().GetFaceVertices(face).size(); }
  /// Whether the face is one patch.
  bool is_whole(int face) const { return face_size(face) == regular_size_; }
  bool is_loop() const { return regular_size_ == 3; }
  bool has_limit(int face) const { return has_limit_[size_t(face)] != 0; }
  const Factory& factory() const { return *factory_; }

  /// Face parameters, as Bfr has them, of (u, v) in a patch.
  void face_parameters(uint32_t patch, float u, float v, float (&face_uv)[2]) const;

  SharedSide shared_side(uint32_t patch, int side) const;
  Location shared_corner(uint32_t patch, int corner) const;

  /// A face-varying primitive variable with equal values at a vertex merged: a channel of the
  /// refiner. Null when `primvar` is none of the geometry's face-varying ones.
  struct Channel {
    const Parameter* primvar = nullptr;
    std::vector<int> value_of_corner;
    std::vector<float> values;
  };
  const Channel* channel_of(const Parameter& primvar, int& index) const;

 private:
  using Level = OpenSubdiv::Far::TopologyLevel;
  struct Owner {
    int face = -1, local = 0;
  };

  const Level& level() const { return refiner_->GetLevel(0); }
  uint32_t patch_of(int face, int local) const {
    return first_patch_[size_t(face)] + uint32_t(is_whole(face) ? 0 : local);
  }
  void build_channels(const Geometry& geometry);
  void build_refiner(const Geometry& geometry);
  /// The face whose evaluation is used along an edge: the first one that is whole, else the first.
  Owner edge_owner(int edge, bool& has_part_faces) const;
  Owner vertex_owner(int vertex) const;
  /// The vertex where a side of a whole face begins.
  int first_vertex_of_side(int face, int side) const;
  SharedSide whole_side(int face, int side) const;
  /// The half of edge `local` of a face, from its vertex `vertex` to its middle.
  SharedSide half_side(int face, int local, int vertex) const;
  Location vertex_location(int vertex) const;
  Location edge_middle(int face, int local) const;

  int regular_size_ = 4;
  std::vector<Channel> channels_;
  std::unique_ptr<OpenSubdiv::Far::TopologyRefiner> refiner_;
  std::unique_ptr<Factory> factory_;
  std::vector<char> has_limit_;
  std::vector<uint32_t> first_patch_;  // of each face, and their number
};

}  // namespace tessera

#include "dice/subdivision_topology.h"

#include <algorithm>
#include <map>

#include <opensubdiv/far/topologyDescriptor.h>

#include "base/error.h"
#include "dice/subdivision.h"

namespace tessera {

namespace {

using namespace OpenSubdiv;

Sdc::Options scheme_options(const SubdivisionMesh& mesh) {
  Sdc::Options options;
  using Boundary = SubdivisionMesh::Boundary;
  options.SetVtxBoundaryInterpolation(
      mesh.boundary == Boundary::none              ? Sdc::Options::VTX_BOUNDARY_NONE
      : mesh.boundary == Boundary::edge_and_corner ? Sdc::Options::VTX_BOUNDARY_EDGE_AND_CORNER
                                                   : Sdc::Options::VTX_BOUNDARY_EDGE_ONLY);
  // The RenderMan values 0 (bilinear), 1 (edge and corner), 2 (edge only), 3 (always sharp) under
  // OpenSubdiv's names, which say what stays linear.
  constexpr Sdc::Options::FVarLinearInterpolation linear[4] = {
      Sdc::Options::FVAR_LINEAR_ALL, Sdc::Options::FVAR_LINEAR_CORNERS_PLUS1,
      Sdc::Options::FVAR_LINEAR_NONE, Sdc::Options::FVAR_LINEAR_BOUNDARIES};
  options.SetFVarLinearInterpolation(linear[std::clamp(mesh.facevarying_boundary, 0, 3)]);
  return options;
}

// Sides of a whole face in the order of its edges, and back; a triangle's side 2 is one point.
int side_of_edge(int face_size, int local) { return face_size == 3 && local == 2 ? 3 : local; }
int edge_of_side(int face_size, int side) { return face_size == 3 && side == 3 ? 2 : side; }

// Face vertex at a corner of a whole face's patch, and back.
int vertex_of_corner(int face_size, int corner) {
  constexpr int quad[4] = {0, 1, 3, 2}, triangle[4] = {0, 1, 2, 2};
  return face_size == 3 ? triangle[corner] : quad[corner];
}
int corner_of_vertex(int face_size, int local) {
  constexpr int quad[4] = {0, 1, 3, 2};
  return face_size == 3 ? local : quad[local];
}

}  // namespace

SubdivisionTopology::SubdivisionTopology(const Geometry& geometry) {
  const SubdivisionMesh& mesh = std::get<SubdivisionMesh>(geometry.shape);
  regular_size_ = mesh.scheme == SubdivisionMesh::Scheme::loop ? 3 : 4;
  build_channels(geometry);
  build_refiner(geometry);
  factory_ = std::make_unique<Factory>(*refiner_);
  const int faces = level().GetNumFaces();
  first_patch_.push_back(0);
  for (int face = 0; face < faces; ++face) {
    has_limit_.push_back(factory_->FaceHasLimitSurface(face));
    first_patch_.push_back(first_patch_.back() + uint32_t(is_whole(face) ? 1 : face_size(face)));
  }
}

void SubdivisionTopology::build_channels(const Geometry& geometry) {
  const SubdivisionMesh& mesh = std::get<SubdivisionMesh>(geometry.shape);
  for (const Parameter& p : geometry.primvars) {
    if (p.storage != StorageClass::facevarying || !is_numeric_primvar(p)) continue;
    if (p.value_count() < mesh.face_vertices.size()) continue;
    Channel channel;
    channel.primvar = &p;
    const size_t n = size_t(p.floats_per_value());
    // Values met so far at each vertex.
    std::vector<std::vector<int>> values_of_vertex(geometry.P_object[0].size());
    for (size_t corner = 0; corner < mesh.face_vertices.size(); ++corner) {
      const float* value = p.numbers.data() + corner * n;
      std::vector<int>& known = values_of_vertex[size_t(mesh.face_vertices[corner])];
      const auto same = std::find_if(known.begin(), known.end(), [&](int k) {
        return std::equal(value, value + n, channel.values.data() + size_t(k) * n);
      });
      if (same != known.end()) {
        channel.value_of_corner.push_back(*same);
        continue;
      }
      const int index = int(channel.values.size() / n);
      known.push_back(index);
      channel.value_of_corner.push_back(index);
      channel.values.insert(channel.values.end(), value, value + n);
    }
    channels_.push_back(std::move(channel));
  }
}

void SubdivisionTopology::build_refiner(const Geometry& geometry) {
  const SubdivisionMesh& mesh = std::get<SubdivisionMesh>(geometry.shape);
  std::vector<int> crease_vertices, corner_vertices;
  std::vector<float> crease_weights, corner_weights;
  for (const auto& crease : mesh.creases) {
    crease_vertices.insert(crease_vertices.end(), {crease.v0, crease.v1});
    crease_weights.push_back(crease.sharpness);
  }
  for (const auto& corner : mesh.corners) {
    corner_vertices.push_back(corner.vertex);
    corner_weights.push_back(corner.sharpness);
  }
  std::vector<Far::TopologyDescriptor::FVarChannel> channels(channels_.size());
  for (size_t c = 0; c < channels.size(); ++c) {
    const size_t n = size_t(channels_[c].primvar->floats_per_value());
    channels[c].numValues = int(channels_[c].values.size() / n);
    channels[c].valueIndices = channels_[c].value_of_corner.data();
  }
  Far::TopologyDescriptor descriptor;
  descriptor.numVertices = int(geometry.P_object[0].size());
  descriptor.numFaces = int(mesh.face_vertex_counts.size());
  descriptor.numVertsPerFace = mesh.face_vertex_counts.data();
  descriptor.vertIndicesPerFace = mesh.face_vertices.data();
  descriptor.numCreases = int(crease_weights.size());
  descriptor.creaseVertexIndexPairs = crease_vertices.data();
  descriptor.creaseWeights = crease_weights.data();
  descriptor.numCorners = int(corner_weights.size());
  descriptor.cornerVertexIndices = corner_vertices.data();
  descriptor.cornerWeights = corner_weights.data();
  descriptor.numHoles = int(mesh.holes.size());
  descriptor.holeIndices = mesh.holes.data();
  descriptor.numFVarChannels = int(channels.size());
  descriptor.fvarChannels = channels.data();
  using RefinerFactory = Far::TopologyRefinerFactory<Far::TopologyDescriptor>;
  RefinerFactory::Options options(regular_size_ == 3 ? Sdc::SCHEME_LOOP : Sdc::SCHEME_CATMARK,
                                  scheme_options(mesh));
  refiner_.reset(RefinerFactory::Create(descriptor, options));
  if (!refiner_) {
    throw Error(geometry.where,
                "OpenSubdiv refused the topology of this SubdivisionMesh; expected faces of at "
                "least three vertices and at most 255 faces at a vertex");
  }
}

int SubdivisionTopology::face_of(uint32_t patch) const {
  const auto after = std::upper_bound(first_patch_.begin(), first_patch_.end(), patch);
  return int(after - first_patch_.begin()) - 1;
}

void SubdivisionTopology::face_parameters(uint32_t patch, float u, float v,
                                          float (&face_uv)[2]) const {
  const int face = face_of(patch);
  if (!is_whole(face)) {
    const float sub_uv[2] = {u, v};
    factory_->GetFaceParameterization(face).ConvertNormalizedSubFaceToCoord(
        int(patch - first_patch_[size_t(face)]), sub_uv, face_uv);
  } else {
    face_uv[0] = is_loop() ? (1.0f - v) * u : u;
    face_uv[1] = v;
  }
}

SubdivisionTopology::Owner SubdivisionTopology::edge_owner(int edge, bool& has_part_faces) const {
  const auto faces = level().GetEdgeFaces(edge);
  const auto locals = level().GetEdgeFaceLocalIndices(edge);
  Owner owner;
  has_part_faces = false;
  bool owner_is_whole = false;
  for (int i = 0; i < faces.size(); ++i) {
    if (!has_limit(faces[i])) continue;
    const bool whole = is_whole(faces[i]);
    has_part_faces |= !whole;
    if (owner.face < 0 || (whole && !owner_is_whole)) {
      owner = {faces[i], locals[i]};
      owner_is_whole = whole;
    }
  }
  return owner;
}

SubdivisionTopology::Owner SubdivisionTopology::vertex_owner(int vertex) const {
  const auto faces = level().GetVertexFaces(vertex);
  const auto locals = level().GetVertexFaceLocalIndices(vertex);
  for (int i = 0; i < faces.size(); ++i) {
    if (has_limit(faces[i])) return {faces[i], locals[i]};
  }
  return {};
}

int SubdivisionTopology::first_vertex_of_side(int face, int side) const {
  constexpr int first_corner[4] = {0, 1, 2, 0};
  return level().GetFaceVertices(face)[vertex_of_corner(regular_size_, first_corner[side])];
}

SharedSide SubdivisionTopology::whole_side(int face, int side) const {
  SharedSide shared;
  shared.curve.patch = patch_of(face, 0);
  shared.curve.line = Curve::Line(side);
  if (is_loop() && side == 2) return shared;
  const int edge = level().GetFaceEdges(face)[edge_of_side(regular_size_, side)];
  const Owner owner = edge_owner(edge, shared.forced_split);
  const int owner_side = side_of_edge(regular_size_, owner.local);
  shared.curve.patch = patch_of(owner.face, owner.local);
  shared.curve.line = Curve::Line(owner_side);
  shared.reversed =
      first_vertex_of_side(face, side) != first_vertex_of_side(owner.face, owner_side);
  return shared;
}

SharedSide SubdivisionTopology::half_side(int face, int local, int vertex) const {
  SharedSide shared;
  bool has_part_faces = false;
  const Owner owner = edge_owner(level().GetFaceEdges(face)[local], has_part_faces);
  if (is_whole(owner.face)) {
    const int side = side_of_edge(regular_size_, owner.local);
    shared.curve.patch = patch_of(owner.face, owner.local);
    shared.curve.line = Curve::Line(side);
    shared.reversed = first_vertex_of_side(owner.face, side) != vertex;
    shared.t0 = shared.reversed ? 0.5 : 0.0;
    shared.t1 = shared.reversed ? 1.0 : 0.5;
    return shared;
  }
  const bool first = level().GetFaceVertices(owner.face)[owner.local] == vertex;
  const int corner = first ? owner.local : (owner.local + 1) % face_size(owner.face);
  shared.curve.patch = patch_of(owner.face, corner);
  shared.curve.line = first ? Curve::Line::side0 : Curve::Line::side3;
  return shared;
}

SharedSide SubdivisionTopology::shared_side(uint32_t patch, int side) const {
  const int face = face_of(patch);
  if (is_whole(face)) return whole_side(face, side);
  const int n = face_size(face), local = int(patch - first_patch_[size_t(face)]);
  const int vertex = level().GetFaceVertices(face)[local];
  if (side == 0) return half_side(face, local, vertex);
  if (side == 3) return half_side(face, (local + n - 1) % n, vertex);
  // From the middle of an edge to the centre: side 1 of the corner before the edge.
  SharedSide shared;
  shared.curve.patch = patch_of(face, side == 1 ? local : (local + n - 1) % n);
  shared.curve.line = Curve::Line::side1;
  return shared;
}

Location SubdivisionTopology::vertex_location(int vertex) const {
  const Owner owner = vertex_owner(vertex);
  if (!is_whole(owner.face)) return own_corner(patch_of(owner.face, owner.local), 0);
  return own_corner(patch_of(owner.face, 0), corner_of_vertex(regular_size_, owner.local));
}

Location SubdivisionTopology::edge_middle(int face, int local) const {
  bool has_part_faces = false;
  const Owner owner = edge_owner(level().GetFaceEdges(face)[local], has_part_faces);
  if (!is_whole(owner.face)) return own_corner(patch_of(owner.face, owner.local), 1);
  Location middle;
  middle.curve.patch = patch_of(owner.face, owner.local);
  middle.curve.line = Curve::Line(side_of_edge(regular_size_, owner.local));
  middle.t = 0.5;
  return middle;
}

Location SubdivisionTopology::shared_corner(uint32_t patch, int corner) const {
  const int face = face_of(patch);
  const auto vertices = level().GetFaceVertices(face);
  if (is_whole(face)) return vertex_location(vertices[vertex_of_corner(regular_size_, corner)]);
  const int n = face_size(face), local = int(patch - first_patch_[size_t(face)]);
  switch (corner) {
    case 0:
      return vertex_location(vertices[local]);
    case 1:
      return edge_middle(face, local);
    case 2:
      return edge_middle(face, (local + n - 1) % n);
    default:
      return own_corner(patch_of(face, 0), 3);
  }
}

const SubdivisionTopology::Channel* SubdivisionTopology::channel_of(const Parameter& primvar,
                                                                    int& index) const {
  for (size_t c = 0; c < channels_.size(); ++c) {
    if (channels_[c].primvar != &primvar) continue;
    index = int(c);
    return &channels_[c];
  }
  return nullptr;
}

std::shared_ptr<const SubdivisionTopology> make_subdivision_topology(const Geometry& geometry) {
  return std::make_shared<SubdivisionTopology>(geometry);
}

}  // namespace tessera

/// SubdivisionMesh with its tags.

#include <algorithm>
#include <span>

#include "scenes/rib/request.h"

namespace tessera {

namespace {

/// One tag with its share of the integer and float arguments.
struct Tag {
  const std::string& name;
  std::span<const int> integers;
  std::span<const double> floats;
};

void crease(SubdivisionMesh& mesh, const Tag& tag, const RibArguments& arguments) {
  const size_t edges = tag.integers.size() < 2 ? 0 : tag.integers.size() - 1;
  if (edges == 0) arguments.fail("a crease needs two vertices or more, found fewer");
  if (tag.floats.size() != 1 && tag.floats.size() != edges)
    arguments.fail("a crease of {} edges needs one sharpness or {}, found {}", edges, edges,
                   tag.floats.size());
  for (size_t i = 0; i < edges; ++i)
    mesh.creases.push_back(
        {tag.integers[i], tag.integers[i + 1], float(tag.floats[tag.floats.size() == 1 ? 0 : i])});
}

void corner(SubdivisionMesh& mesh, const Tag& tag, const RibArguments& arguments) {
  const size_t count = tag.integers.size();
  if (tag.floats.size() != 1 && tag.floats.size() != count)
    arguments.fail("a corner tag of {} vertices needs one sharpness or {}, found {}", count, count,
                   tag.floats.size());
  for (size_t i = 0; i < count; ++i)
    mesh.corners.push_back({tag.integers[i], float(tag.floats[tag.floats.size() == 1 ? 0 : i])});
}

/// interpolateboundary without an argument means 1: edges and corners.
void boundary(SubdivisionMesh& mesh, const Tag& tag, const RibArguments& arguments) {
  const int value = tag.integers.empty() ? 1 : tag.integers[0];
  if (value < 0 || value > 2)
    arguments.fail("\"interpolateboundary\": expected 0, 1 or 2, found {}", value);
  mesh.boundary = SubdivisionMesh::Boundary(value);
}

void facevarying_boundary(SubdivisionMesh& mesh, const Tag& tag, const RibArguments& arguments) {
  const int value = tag.integers.empty() ? 1 : tag.integers[0];
  if (value < 0 || value > 3)
    arguments.fail("\"facevaryinginterpolateboundary\": expected 0 to 3, found {}", value);
  mesh.facevarying_boundary = value;
}

void apply(SubdivisionMesh& mesh, const Tag& tag, RibSession& session,
           const RibArguments& arguments) {
  if (tag.name == "crease")
    crease(mesh, tag, arguments);
  else if (tag.name == "corner")
    corner(mesh, tag, arguments);
  else if (tag.name == "hole")
    mesh.holes.insert(mesh.holes.end(), tag.integers.begin(), tag.integers.end());
  else if (tag.name == "interpolateboundary")
    boundary(mesh, tag, arguments);
  else if (tag.name == "facevaryinginterpolateboundary")
    facevarying_boundary(mesh, tag, arguments);
  else if (tag.name != "facevaryingpropagatecorners" ||
           (!tag.integers.empty() && tag.integers[0] != 0))
    session.diagnostics().warn_once(
        "subdivision-tag:" + tag.name, arguments.where(),
        fmt::format("the subdivision tag \"{:.60}\" is not supported: left out", tag.name));
}

void read_tags(SubdivisionMesh& mesh, RibSession& session, RibArguments& arguments) {
  const std::vector<std::string> names = arguments.string_array();
  const std::vector<int> counts = arguments.integer_array();
  const std::vector<int> integers = arguments.integer_array();
  const std::vector<double> floats = arguments.number_array();
  if (counts.size() != 2 * names.size())
    arguments.fail("expected two argument counts for each of {} tags, found {}", names.size(),
                   counts.size());
  size_t integers_used = 0, floats_used = 0;
  const auto share = [&](const auto& values, size_t& used, int count, const std::string& name) {
    if (count < 0 || size_t(count) > values.size() - used)
      arguments.fail("tag \"{:.60}\": expected {} arguments, found {} left", name, count,
                     values.size() - used);
    const std::span part(values.data() + used, size_t(count));
    used += size_t(count);
    return part;
  };
  for (size_t i = 0; i < names.size(); ++i)
    apply(mesh,
          {names[i], share(integers, integers_used, counts[2 * i], names[i]),
           share(floats, floats_used, counts[2 * i + 1], names[i])},
          session, arguments);
  if (integers_used != integers.size() || floats_used != floats.size())
    arguments.fail("expected {} integer and {} float tag arguments, found {} and {}", integers_used,
                   floats_used, integers.size(), floats.size());
}

/// Whether tags come next. The short form goes on with the parameters, whose names are strings and
/// not arrays; a single tag may have lost its brackets, but then no parameter has its name.
bool tags_follow(const RibArguments& arguments) {
  if (arguments.next_is_string_array()) return true;
  static constexpr const char* tag_names[] = {"crease", "corner", "hole", "interpolateboundary",
                                              "facevaryinginterpolateboundary"};
  const RibValue* next = arguments.peek();
  return next && next->kind == RibValue::Kind::string &&
         std::find(std::begin(tag_names), std::end(tag_names), next->strings[0]) !=
             std::end(tag_names);
}

void subdivision_mesh(RibSession& session, RibArguments& arguments) {
  SubdivisionMesh mesh;
  const std::string scheme = arguments.string();
  if (scheme != "catmull-clark" && scheme != "loop")
    arguments.fail("expected \"catmull-clark\" or \"loop\", found \"{:.60}\"", scheme);
  mesh.scheme =
      scheme == "loop" ? SubdivisionMesh::Scheme::loop : SubdivisionMesh::Scheme::catmull_clark;
  mesh.face_vertex_counts = arguments.integer_array();
  mesh.face_vertices = arguments.integer_array();
  if (tags_follow(arguments)) read_tags(mesh, session, arguments);
  session.calls().shape(
      {std::move(mesh), arguments.parameters(session.declarations(), session.diagnostics())},
      arguments.where());
}

const RibRequestRow rows[] = {{"SubdivisionMesh", subdivision_mesh}};

}  // namespace

RibRequestTable rib_request_geometry_subdivision() { return {rows}; }

}  // namespace tessera

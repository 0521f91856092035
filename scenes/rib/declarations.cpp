#include "scenes/rib/declarations.h"

#include <charconv>
#include <vector>

namespace tessera {

namespace {

constexpr int largest_array_size = 1 << 20;

using Words = std::vector<std::string_view>;

/// Splits at white space; "float[3]" gives "float" and "[3]".
Words split(std::string_view text) {
  Words words;
  size_t i = 0;
  const auto is_space = [](char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; };
  while (i < text.size()) {
    if (is_space(text[i])) {
      ++i;
      continue;
    }
    size_t end = i + 1;
    if (text[i] == '[') {
      end = std::min(text.find(']', i), text.size() - 1) + 1;
    } else {
      while (end < text.size() && !is_space(text[end]) && text[end] != '[') ++end;
    }
    words.push_back(text.substr(i, end - i));
    i = end;
  }
  return words;
}

std::optional<StorageClass> storage_named(std::string_view word) {
  for (StorageClass storage : {StorageClass::constant, StorageClass::uniform, StorageClass::varying,
                               StorageClass::vertex, StorageClass::facevarying})
    if (word == name_of(storage)) return storage;
  if (word == "facevertex") return StorageClass::facevarying;
  return std::nullopt;
}

std::optional<ValueType> type_named(std::string_view word) {
  for (ValueType type : {ValueType::integer, ValueType::scalar, ValueType::point, ValueType::vector,
                         ValueType::normal, ValueType::color, ValueType::hpoint, ValueType::matrix,
                         ValueType::string})
    if (word == name_of(type)) return type;
  if (word == "int") return ValueType::integer;
  return std::nullopt;
}

std::optional<int> array_size(std::string_view word) {
  if (word.size() < 3 || word.front() != '[' || word.back() != ']') return std::nullopt;
  int size = 0;
  const char* last = word.data() + word.size() - 1;
  const auto [stop, status] = std::from_chars(word.data() + 1, last, size);
  if (status != std::errc() || stop != last || size < 1 || size > largest_array_size)
    return std::nullopt;
  return size;
}

/// Takes "[class] type ["[n]"]" off the front of `words`; nothing if they do not start so.
std::optional<Declaration> take_declaration(Words& words) {
  Declaration result;
  size_t used = 0;
  if (used < words.size())
    if (const auto storage = storage_named(words[used])) result.storage = *storage, ++used;
  if (used == words.size()) return std::nullopt;
  const auto type = type_named(words[used++]);
  if (!type) return std::nullopt;
  result.type = *type;
  if (used < words.size() && words[used].front() == '[') {
    const auto size = array_size(words[used++]);
    if (!size) return std::nullopt;
    result.array_size = *size;
  }
  words.erase(words.begin(), words.begin() + long(used));
  return result;
}

struct StandardParameters {
  const char* declaration;
  std::vector<const char*> names;
};

std::vector<StandardParameters> standard_parameters() {
  return {
      // Primitive variables.
      {"vertex point", {"P"}},
      {"vertex hpoint", {"Pw"}},
      {"vertex float", {"Pz"}},
      {"varying normal", {"N"}},
      {"uniform normal", {"Np"}},
      {"varying color", {"Cs", "Os"}},
      {"varying float", {"s", "t"}},
      {"varying float[2]", {"st"}},
      // Shaders and lights.
      {"uniform float",
       {"Ka", "Kd", "Ks", "Kr", "Kt", "Km", "roughness", "intensity", "coneangle", "conedeltaangle",
        "beamdistribution", "mindistance", "maxdistance", "distance", "frequency", "amplitude",
        "octaves"}},
      {"uniform color", {"specularcolor", "lightcolor", "background"}},
      {"uniform point", {"from", "to"}},
      {"uniform string", {"texturename", "shadowname"}},
      // Options, attributes, displays.
      {"uniform float", {"fov", "sphere", "lensrotation", "rate"}},
      {"uniform integer",
       {"bucketsize", "gridsize", "texturememory", "eyesplits", "endofframe", "jitter",
        "lensblades", "merge", "truedisplacement", "trace", "binary"}},
      {"uniform integer[2]", {"origin"}},
      {"uniform string",
       {"name", "shadinggroup", "coordinatesystem", "shader", "texture", "archive", "procedural",
        "display", "resource", "depthfilter", "compression", "lensprofile", "shutterprofile"}},
  };
}

}  // namespace

Declarations::Declarations() {
  for (const StandardParameters& group : standard_parameters())
    for (const char* name : group.names) declare(name, group.declaration, {});
}

void Declarations::declare(const std::string& name, const std::string& declaration,
                           const SourceLocation& where) {
  Words words = split(declaration);
  const auto parsed = take_declaration(words);
  if (!parsed || !words.empty())
    throw Error(where, fmt::format("expected a declaration such as \"uniform float[2]\", found "
                                   "\"{:.60}\"",
                                   declaration));
  declared_[name] = *parsed;
}

Declarations::Resolved Declarations::resolve(const std::string& token,
                                             const SourceLocation& where) const {
  Words words = split(token);
  if (words.size() > 1) {
    const auto parsed = take_declaration(words);
    if (!parsed || words.size() != 1)
      throw Error(where, fmt::format("expected a parameter such as \"Kd\" or \"uniform float Kd\", "
                                     "found \"{:.60}\"",
                                     token));
    return {std::string(words[0]), parsed};
  }
  const auto found = declared_.find(token);
  if (found == declared_.end()) return {token, std::nullopt};
  return {token, found->second};
}

}  // namespace tessera

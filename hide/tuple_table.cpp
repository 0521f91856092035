#include "hide/tuple_table.h"

#include <algorithm>
#include <numbers>
#include <numeric>

#include "base/error.h"
#include "base/hash.h"
#include "hide/owen_points.h"
#include "hide/sobol.h"

namespace tessera {
namespace {

const char* kind_name(SampleTuples::Kind kind) {
  switch (kind) {
    case SampleTuples::Kind::free:
      return "free";
    case SampleTuples::Kind::interleaved:
      return "interleaved";
    case SampleTuples::Kind::accumulated:
      return "accumulated";
    case SampleTuples::Kind::lens_lines:
      return "lens_lines";
  }
  return "";
}

/// Divisors of `total` up to max_tuples, in ascending order.
std::string list_divisors(int total) {
  std::string list;
  for (int d = 1; d <= std::min(total, max_tuples); ++d)
    if (total % d == 0) list += fmt::format("{}{}", list.empty() ? "" : ", ", d);
  return list;
}

/// Owen-scrambled coordinates of the first `count` Sobol points in one dimension, in [0, 1).
AlignedVector<float> scrambled_dimension(int dimension, int count, uint32_t seed) {
  const size_t size = padded(size_t(count)) + simd_padding;
  AlignedVector<uint32_t> digits(size, 0);
  for (int k = 0; k < count; ++k) digits[size_t(k)] = sobol_reversed(dimension, uint32_t(k));
  AlignedVector<float> values(size);
  scramble_points(digits.data(), size_t(count), hash_combine(seed, uint32_t(dimension)),
                  values.data());
  return values;
}

/// Numbers the tuples in order of time, so that a pixel's samples are in that order if their tuples
/// are.
void order_by_time(TupleTable& table, size_t count) {
  std::vector<uint32_t> order(count);
  std::iota(order.begin(), order.end(), 0u);
  std::stable_sort(order.begin(), order.end(),
                   [&](uint32_t a, uint32_t b) { return table.t[a] < table.t[b]; });
  for (size_t k = 0; k < count; ++k) table.number[order[k]] = uint32_t(k);
  for (auto* axis : {&table.x, &table.y, &table.u, &table.v, &table.t}) {
    if (axis->empty()) continue;
    const AlignedVector<float> unordered = *axis;
    for (size_t k = 0; k < count; ++k) (*axis)[k] = unordered[order[k]];
  }
}

}  // namespace

std::string to_string(const SampleTuples& tuples) {
  const char* name = kind_name(tuples.kind);
  return tuples.kind == SampleTuples::Kind::free ? name : fmt::format("{}:{}", name, tuples.count);
}

glm::vec2 lens_line_direction(int line, int count) {
  const double angle = std::numbers::pi * double(line) / double(count);
  return {float(std::cos(angle)), float(std::sin(angle))};
}

void check_tuples(const SampleTuples& tuples, int samples_per_pixel) {
  if (tuples.kind == SampleTuples::Kind::free) return;
  const std::string found = to_string(tuples);
  if (tuples.kind == SampleTuples::Kind::lens_lines) {
    if (tuples.count < 1 || tuples.count > max_tuples)
      throw Error(fmt::format("samples {}: expected 1 to {} lines", found, max_tuples));
    return;
  }
  const bool tiles = tuples.kind == SampleTuples::Kind::interleaved;
  const int total = tiles ? 4 * samples_per_pixel : samples_per_pixel;
  if (tuples.count >= 1 && tuples.count <= max_tuples && total % tuples.count == 0) return;
  throw Error(fmt::format("samples {}: {} has {} samples; expected a number of tuples among {}",
                          found, tiles ? "a tile of 2 x 2 pixels" : "a pixel", total,
                          list_divisors(total)));
}

TupleTable make_tuple_table(const SampleTuples& tuples, uint32_t seed, const SampleWarps& warps) {
  TupleTable table;
  const bool interleaved = tuples.kind == SampleTuples::Kind::interleaved;
  if (!interleaved && tuples.kind != SampleTuples::Kind::accumulated) return table;
  const size_t count = size_t(tuples.count);
  // The first dimensions of the sequence are the best distributed. Its own seed keeps the table
  // apart from the positions in the pixels.
  const int lens_dimension = interleaved ? 0 : 2, time_dimension = interleaved ? 2 : 4;
  const auto dimension = [&](int d) {
    return scrambled_dimension(d, tuples.count, hash_combine(seed, 0x7ab1e5u));
  };
  if (!interleaved) table.x = dimension(0), table.y = dimension(1);
  if (warps.has_lens()) {
    table.u = dimension(lens_dimension), table.v = dimension(lens_dimension + 1);
    warps.lens(table.u.data(), table.v.data(), count);
  }
  table.number.resize(count);
  std::iota(table.number.begin(), table.number.end(), 0u);
  if (warps.has_time()) {
    table.t = dimension(time_dimension);
    warps.time(table.t.data(), count);
    order_by_time(table, count);
  }
  return table;
}

}  // namespace tessera

#include "dice/patch_primvar.h"

#include <algorithm>

namespace tessera {

void PatchPrimvar::evaluate(std::span<const float> u, std::span<const float> v, float* out,
                            size_t stride) const {
  if (custom) return custom(u, v, out, stride);
  const size_t n = size_t(components);
  for (size_t c = 0; c < n; ++c) {
    float* run = out + c * stride;
    if (values.size() == n) {
      std::fill(run, run + u.size(), values[c]);
      continue;
    }
    const float a = values[c], b = values[n + c], d = values[2 * n + c], e = values[3 * n + c];
    for (size_t i = 0; i < u.size(); ++i) {
      const float low = (1.0f - u[i]) * a + u[i] * b, high = (1.0f - u[i]) * d + u[i] * e;
      run[i] = (1.0f - v[i]) * low + v[i] * high;
    }
  }
}

namespace {

void append_value(const Parameter& source, size_t index, std::vector<float>& values) {
  const size_t n = size_t(source.floats_per_value());
  const size_t last = source.value_count() - 1;
  const float* first = source.numbers.data() + std::min(index, last) * n;
  values.insert(values.end(), first, first + n);
}

}  // namespace

PatchPrimvar constant_primvar(const Parameter& source, size_t index) {
  PatchPrimvar primvar;
  primvar.source = &source;
  primvar.components = source.floats_per_value();
  append_value(source, index, primvar.values);
  return primvar;
}

PatchPrimvar bilinear_primvar(const Parameter& source, const size_t (&corner_index)[4]) {
  PatchPrimvar primvar;
  primvar.source = &source;
  primvar.components = source.floats_per_value();
  for (size_t index : corner_index) append_value(source, index, primvar.values);
  return primvar;
}

bool is_numeric_primvar(const Parameter& parameter) {
  return parameter.type != ValueType::string && parameter.floats_per_value() > 0 &&
         parameter.value_count() > 0;
}

}  // namespace tessera

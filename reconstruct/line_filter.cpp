#include <cmath>

#include <tbb/parallel_for.h>

#include "reconstruct/stack_filter.h"

namespace tessera {
namespace {

/// One pixel at a time: each has a direction of its own.
class LineFilter {
 public:
  explicit LineFilter(const StackFilterInput& input)
      : input_(input),
        reach_(input.stack->method->reach()),
        taps_(size_t(2 * reach_ + 1)),
        weights_(size_t(input.stack->method->basis_count()) * taps_) {}

  void filter(int x, int y, StackFilterOutput& out) {
    const PixelFacts& facts = *input_.facts;
    const size_t at = facts.index(x, y);
    const WedgePlanes& wedges = facts.wedges[size_t(input_.stack->blur)];
    const BlurLine line = blur_line(wedges, at);
    input_.stack->method->weights(narrowed(line.wedge, input_.wedge_width), facts.samples[at],
                                  weights_.data());
    for (int d = -reach_; d <= reach_; ++d) {
      const int qx = x + int(std::lround(float(d) * line.dx));
      const int qy = y + int(std::lround(float(d) * line.dy));
      if (!facts.rect().contains(qx, qy)) continue;
      const size_t q = facts.index(qx, qy);
      if (input_.shared && (*input_.shared)[q] == 0.0f) continue;
      add_tap(at, q, size_t(d + reach_), out);
      if (std::abs(d) <= NoiseCorrelation::reach)
        out.own_weight[at] += weights_[size_t(d + reach_)] * correlation(qx - x, qy - y);
    }
  }

 private:
  void add_tap(size_t at, size_t q, size_t tap, StackFilterOutput& out) const {
    const MomentStack& stack = *input_.stack;
    for (size_t p = 0; p < stack.pairs.size(); ++p) {
      const float weight = weights_[size_t(stack.pairs[p].j) * taps_ + tap];
      if (weight == 0.0f) continue;
      for (size_t v = 0; v < stack.value_count; ++v)
        out.values[v][at] += weight * (*input_.planes)[stack.plane(p, v)][q];
    }
  }
  float correlation(int dx, int dy) const {
    return input_.correlation.x[size_t(std::abs(dx))] * input_.correlation.y[size_t(std::abs(dy))];
  }

  const StackFilterInput& input_;
  int reach_;
  size_t taps_;
  std::vector<float> weights_;
};

}  // namespace

StackFilterOutput filter_lines(const StackFilterInput& input, const std::vector<uint8_t>& wanted) {
  const PixelRect& rect = input.facts->rect();
  const size_t pixels = size_t(rect.pixel_count());
  StackFilterOutput out{Planes(input.stack->value_count, std::vector<float>(pixels)),
                        std::vector<float>(pixels)};
  tbb::parallel_for(rect.y0, rect.y1, [&](int y) {
    LineFilter filter(input);
    for (int x = rect.x0; x < rect.x1; ++x)
      if (wanted[input.facts->index(x, y)]) filter.filter(x, y, out);
  });
  return out;
}

}  // namespace tessera

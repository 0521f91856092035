#include "reconstruct/stack_filter.h"

#include <algorithm>

#include <tbb/parallel_for.h>

#include "reconstruct/weighted_taps.h"

namespace tessera {
namespace {

/// Rows that one task filters: enough for the columns' taps to be read from the cache.
constexpr int band_rows = 8;

/// The weights of a run of pixels along one axis, made anew for each run.
class RunWeights {
 public:
  explicit RunWeights(const StackFilterInput& input)
      : input_(input),
        reach_(input.stack->method->reach()),
        taps_(2 * reach_ + 1),
        functions_(size_t(input.stack->method->basis_count())),
        pixel_(functions_ * size_t(taps_)),
        values_(pixel_.size() * tap_run) {}

  /// For pixels [x0, x1) of row y along `axis`. A column's weights leave out outliers: the row pass
  /// sees sums over columns that are free of them.
  void make(int x0, int x1, int y, size_t axis) {
    std::fill(values_.begin(), values_.end(), 0.0f);
    const PixelFacts& facts = *input_.facts;
    const PixelRect& rect = facts.rect();
    const int before = axis == 0 ? x0 - rect.x0 : y - rect.y0;
    const int after = axis == 0 ? rect.x1 - 1 - x0 : rect.y1 - 1 - y;
    begin_ = axis == 0 ? 0 : std::max(0, reach_ - before);
    end_ = axis == 0 ? taps_ : std::min(taps_, reach_ + after + 1);
    for (int x = x0; x < x1; ++x) make_pixel(x, y, axis, size_t(x - x0));
  }

  TapWeights view() const { return {values_.data(), size_t(taps_), size_t(begin_), size_t(end_)}; }
  /// own()[pixel of the run]: the axis' factor of StackFilterOutput::own_weight.
  const std::array<float, tap_run>& own() const { return own_; }

 private:
  void make_pixel(int x, int y, size_t axis, size_t column) {
    const PixelFacts& facts = *input_.facts;
    const PixelRect& rect = facts.rect();
    const size_t at = facts.index(x, y);
    const WedgePlanes& wedges = facts.wedges[size_t(input_.stack->blur)];
    if (!wedges.known(at)) {
      own_[column] = 1.0f;
      if (used(at, at, axis)) store(0, reach_, column, 1.0f);
      return;
    }
    input_.stack->method->weights(narrowed(wedges.axis(axis, at), input_.wedge_width),
                                  facts.samples[at], pixel_.data());
    const int position = axis == 0 ? x - rect.x0 : y - rect.y0;
    const int size = axis == 0 ? rect.width() : rect.height();
    const int first = std::max(0, reach_ - position);
    const int last = std::min(taps_ - 1, reach_ + size - 1 - position);
    const std::ptrdiff_t step = axis == 0 ? 1 : rect.width();
    const auto& correlation = axis == 0 ? input_.correlation.x : input_.correlation.y;
    own_[column] = 0.0f;
    for (int t = first; t <= last; ++t) {
      const int d = t - reach_;
      const size_t q = size_t(std::ptrdiff_t(at) + d * step);
      if (!used(at, q, axis)) continue;
      for (size_t k = 0; k < functions_; ++k)
        store(k, t, column, pixel_[k * size_t(taps_) + size_t(t)]);
      if (std::abs(d) <= NoiseCorrelation::reach)
        own_[column] += correlation[size_t(std::abs(d))] * pixel_[size_t(t)];
    }
  }

  bool used(size_t at, size_t q, size_t axis) const {
    if (axis == 1 && input_.shared && (*input_.shared)[q] == 0.0f) return false;
    return q == at || !of_rays(input_.stack->blur) || alike(*input_.facts, at, q);
  }

  void store(size_t k, int tap, size_t column, float weight) {
    values_[(k * size_t(taps_) + size_t(tap)) * tap_run + column] = weight;
  }

  const StackFilterInput& input_;
  int reach_, taps_, begin_ = 0, end_ = 0;
  size_t functions_;
  std::vector<float> pixel_, values_;
  std::array<float, tap_run> own_{};
};

/// The column sums of a band of rows: [row][value][x function][x], columns `reach` to the left of
/// the rectangle first.
class Band {
 public:
  Band(const StackFilterInput& input, int y0, int y1)
      : input_(input),
        weights_(input),
        reach_(size_t(input.stack->method->reach())),
        functions_(size_t(input.stack->method->basis_count())),
        width_(size_t(input.facts->rect().width())),
        stride_((width_ + tap_run - 1) / tap_run * tap_run + 2 * reach_ + tap_run),
        y0_(y0),
        y1_(y1),
        sums_(size_t(y1 - y0) * input.stack->value_count * functions_ * stride_),
        own_(size_t(y1 - y0) * width_) {}

  void filter(StackFilterOutput& out) {
    const PixelRect& rect = input_.facts->rect();
    for (int x = rect.x0; x < rect.x1; x += int(tap_run))
      for (int y = y0_; y < y1_; ++y) step_columns(x, y);
    for (int y = y0_; y < y1_; ++y)
      for (int x = rect.x0; x < rect.x1; x += int(tap_run)) step_rows(x, y, out);
  }

 private:
  float* sums(int y, size_t value, size_t function) {
    const size_t row = size_t(y - y0_) * input_.stack->value_count + value;
    return sums_.data() + (row * functions_ + function) * stride_;
  }
  size_t run_end(int x) const { return std::min(tap_run, size_t(input_.facts->rect().x1 - x)); }

  void step_columns(int x, int y) {
    const PixelFacts& facts = *input_.facts;
    const MomentStack& stack = *input_.stack;
    const size_t run = run_end(x);
    weights_.make(x, x + int(run), y, 1);
    // Tap 0 may lie above the rectangle; taps that do are never read.
    const std::ptrdiff_t first =
        std::ptrdiff_t(facts.index(x, y)) - std::ptrdiff_t(reach_ * width_);
    std::vector<TapTerm> terms;
    float result[tap_run];
    for (size_t v = 0; v < stack.value_count; ++v) {
      for (size_t j = 0; j < functions_; ++j) {
        terms.clear();
        for (size_t p = 0; p < stack.pairs.size(); ++p)
          if (size_t(stack.pairs[p].j) == j)
            terms.push_back(
                {(*input_.planes)[stack.plane(p, v)].data() + first, size_t(stack.pairs[p].k)});
        sum_taps(terms.data(), terms.size(), weights_.view(), width_, result);
        std::copy_n(result, run, sums(y, v, j) + reach_ + size_t(x - facts.rect().x0));
      }
    }
    for (size_t k = 0; k < run; ++k)
      own_[size_t(y - y0_) * width_ + size_t(x - facts.rect().x0) + k] = weights_.own()[k];
  }

  void step_rows(int x, int y, StackFilterOutput& out) {
    const PixelFacts& facts = *input_.facts;
    const size_t run = run_end(x), at = facts.index(x, y), column = size_t(x - facts.rect().x0);
    weights_.make(x, x + int(run), y, 0);
    std::vector<TapTerm> terms(functions_);
    float result[tap_run];
    for (size_t v = 0; v < input_.stack->value_count; ++v) {
      for (size_t j = 0; j < functions_; ++j) terms[j] = {sums(y, v, j) + column, j};
      sum_taps(terms.data(), terms.size(), weights_.view(), 1, result);
      std::copy_n(result, run, out.values[v].data() + at);
    }
    for (size_t k = 0; k < run; ++k)
      out.own_weight[at + k] = weights_.own()[k] * own_[size_t(y - y0_) * width_ + column + k];
  }

  const StackFilterInput& input_;
  RunWeights weights_;
  size_t reach_, functions_, width_, stride_;
  int y0_, y1_;
  std::vector<float> sums_, own_;
};

}  // namespace

StackFilterOutput filter_stack(const StackFilterInput& input) {
  const PixelRect& rect = input.facts->rect();
  const size_t pixels = size_t(rect.pixel_count());
  StackFilterOutput out{Planes(input.stack->value_count, std::vector<float>(pixels)),
                        std::vector<float>(pixels)};
  const int bands = (rect.height() + band_rows - 1) / band_rows;
  tbb::parallel_for(0, bands, [&](int b) {
    const int y0 = rect.y0 + b * band_rows;
    Band(input, y0, std::min(y0 + band_rows, rect.y1)).filter(out);
  });
  return out;
}

}  // namespace tessera

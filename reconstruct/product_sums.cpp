#include "reconstruct/product_sums.h"

#include <algorithm>
#include <cmath>

#include "reconstruct/sample_sums.h"

namespace tessera {
namespace {

/// Rows hold whole runs of this many samples, zeros at the end.
constexpr size_t lanes = 8;

}  // namespace

ProductSums::ProductSums(const std::vector<SampleProducts>& products) : products_(products) {
  size_t count = 0;
  for (const SampleProducts& p : products) {
    channels_ =
        std::max({channels_, p.first_factor + p.factor_count, p.first_value + p.value_count});
    max_factors_ = std::max(max_factors_, p.factor_count);
    count += p.factor_count * p.value_count;
  }
  totals_.resize(count);
  sums_.resize(count);
}

/// Room for so many samples in every row; keeps what is there.
void ProductSums::reserve(size_t samples) {
  if (samples <= stride_) return;
  const size_t wider = std::max(2 * stride_, (samples + lanes - 1) / lanes * lanes);
  std::vector<float> rows((1 + channels_ + max_factors_) * wider);
  for (size_t r = 0; r < 1 + channels_; ++r)
    std::copy_n(rows_.data() + r * stride_, samples_, rows.data() + r * wider);
  rows_ = std::move(rows), stride_ = wider;
}

void ProductSums::add(const WeightedBlock& block, int x, int y, int qx0, int qx1, int qy) {
  const size_t begin = block.first_sample(qx0, qy);
  const size_t end = block.first_sample(qx1 - 1, qy) + block.sample_count(qx1 - 1, qy);
  const size_t count = end - begin;
  reserve(samples_ + count + lanes);
  const float* wy = block.y_weights(y - qy);
  float* weights = row(0) + samples_;
  for (int qx = qx0; qx < qx1; ++qx) {
    const float* wx = block.x_weights(x - qx);
    const size_t first = block.first_sample(qx, qy), last = first + block.sample_count(qx, qy);
    for (size_t k = first; k < last; ++k) weights[k - begin] = wx[k] * wy[k];
  }
  for (size_t c = 0; c < channels_; ++c)
    std::copy_n(block.carried(c) + begin, count, row(1 + c) + samples_);
  samples_ += count;
}

double ProductSums::weight_sum(size_t padded) {
  double partial[lanes] = {};
  for (size_t k = 0; k < padded; ++k) partial[k % lanes] += double(row(0)[k]);
  double sum = 0;
  for (const double p : partial) sum += p;
  return sum;
}

const std::vector<float>& ProductSums::finish() {
  std::fill(totals_.begin(), totals_.end(), 0.0f);
  if (samples_ == 0) return totals_;
  const size_t padded = (samples_ + lanes - 1) / lanes * lanes;
  for (size_t r = 0; r < 1 + channels_; ++r) std::fill(row(r) + samples_, row(r) + padded, 0.0f);
  const double weights = weight_sum(padded);
  if (std::abs(weights) < 1e-20) return totals_;
  double* sums = sums_.data();
  for (const SampleProducts& p : products_) {
    for (size_t f = 0; f < p.factor_count; ++f)
      multiply(row(0), row(1 + p.first_factor + f), padded, row(1 + channels_ + f));
    sum_products(row(1 + channels_), p.factor_count, row(1 + p.first_value), p.value_count, stride_,
                 padded, sums);
    sums += p.factor_count * p.value_count;
  }
  for (size_t k = 0; k < totals_.size(); ++k) {
    const float mean = float(sums_[k] / weights);
    totals_[k] = std::isfinite(mean) ? mean : 0.0f;
  }
  return totals_;
}

}  // namespace tessera

#include "shade/cell_memo.h"

#include <algorithm>

#include "shade/cell_name.h"

namespace tessera {

void CellMemo::claim(std::span<const uint64_t> keys, std::vector<uint32_t>& slots,
                     std::vector<uint32_t>& mine) {
  slots.clear();
  mine.clear();
  const std::scoped_lock lock(mutex_);
  for (uint32_t k = 0; k < keys.size(); ++k) {
    const auto [slot, is_new] = index_.insert(scrambled(keys[k]));
    slots.push_back(slot);
    if (is_new) mine.push_back(k);
  }
  shaded_.resize(index_.size(), false);
  values_.resize(index_.size() * stride_);
}

void CellMemo::publish(std::span<const uint32_t> slots, std::span<const uint32_t> places,
                       std::span<const float> values) {
  {
    const std::scoped_lock lock(mutex_);
    for (const uint32_t k : places) {
      std::copy_n(&values[k * stride_], stride_, &values_[slots[k] * stride_]);
      shaded_[slots[k]] = true;
    }
  }
  published_.notify_all();
}

void CellMemo::read(std::span<const uint32_t> slots, std::span<float> values) {
  std::unique_lock lock(mutex_);
  for (size_t k = 0; k < slots.size(); ++k) {
    published_.wait(lock, [&] { return shaded_[slots[k]] || given_up_; });
    if (!shaded_[slots[k]]) std::rethrow_exception(given_up_);
    std::copy_n(&values_[slots[k] * stride_], stride_, &values[k * stride_]);
  }
}

void CellMemo::give_up(std::exception_ptr reason) {
  {
    const std::scoped_lock lock(mutex_);
    if (!given_up_) given_up_ = std::move(reason);
  }
  published_.notify_all();
}

}  // namespace tessera

#pragma once
/// The shaded cells of one grid, for as long as the grid lives. Whoever first asks for a cell
/// shades it; what it is worth is a property of the grid, so it does not matter who that was.

#include <condition_variable>
#include <exception>
#include <mutex>
#include <optional>
#include <span>
#include <vector>

#include "base/flat_index.h"
#include "shade/shading_space.h"

namespace tessera {

/// Thread safe, but for `space`, which is written under `made` and only read afterwards.
class CellMemo : public GridAttachment {
 public:
  explicit CellMemo(size_t floats_per_cell) : stride_(floats_per_cell) {}

  std::once_flag made;
  std::optional<ShadingSpace> space;

  /// Gives each key its slot; `mine` are the places in `keys` of the cells that nobody has claimed:
  /// the caller must shade and publish() them before it asks for any cell of any grid by read(), and
  /// until then do nothing that might run another bucket on its stack (wait for tasks, say): that
  /// one could come to wait for cells that only its own caller can publish.
  void claim(std::span<const uint64_t> keys, std::vector<uint32_t>& slots,
             std::vector<uint32_t>& mine);
  /// `values` of the cells of `slots`, [slot][float], `places` telling which of the slots are new.
  void publish(std::span<const uint32_t> slots, std::span<const uint32_t> places,
               std::span<const float> values);
  /// Copies the values of `slots`, waiting for those that others are shading. Throws what they gave
  /// up for if they did.
  void read(std::span<const uint32_t> slots, std::span<float> values);
  /// Says that claimed cells will never be published, because of `reason`.
  void give_up(std::exception_ptr reason);

 private:
  std::mutex mutex_;
  std::condition_variable published_;
  FlatIndex index_;
  std::vector<bool> shaded_;   ///< [slot]
  std::vector<float> values_;  ///< [slot][float]
  size_t stride_;
  std::exception_ptr given_up_;
};

}  // namespace tessera

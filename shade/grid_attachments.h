#pragma once
/// What a shading mode keeps with a grid for as long as the grid lives.

#include <array>
#include <memory>
#include <mutex>

#include "dice/grid.h"
#include "shade/cell_name.h"

namespace tessera {

/// Hands out the attachment of a grid, making it for whoever asks first. Thread safe. All users of
/// a grid must go through one GridAttachments, with one type.
class GridAttachments {
 public:
  /// `make` gives a std::unique_ptr<Attachment>. It should be cheap: it runs under a lock that
  /// other grids share. Leave work to a std::once_flag of the attachment.
  template <class Attachment, class Make>
  Attachment& of(const Grid& grid, const Make& make) {
    const std::scoped_lock lock(locks_[grid_name(grid.id) % locks_.size()]);
    if (!grid.attachment) grid.attachment = make();
    return static_cast<Attachment&>(*grid.attachment);
  }

 private:
  std::array<std::mutex, 64> locks_;
};

}  // namespace tessera

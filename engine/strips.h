#pragma once
/// A frame cut into strips of rows, for reconstructions that do not fit into memory as a whole.

#include <vector>

#include "engine/buckets.h"
#include "images/image.h"

namespace tessera {

/// Rows are of buckets; every column belongs to every strip.
struct Strip {
  PixelRect crop;                  ///< the pixels that come of it
  int first_row = 0, end_row = 0;  ///< whose samples they need
  /// Rows from here on no earlier strip had.
  int first_new_row = 0;
  /// Rows before this no later strip needs.
  int end_last_row = 0;

  PixelRect sampled(const BucketLayout& buckets) const;
};

/// Cuts `crop` into `count` strips of about the same height, top to bottom; fewer where it has
/// fewer rows of pixels. A pixel needs the samples `reach` pixels above and below, as far as there
/// are any.
std::vector<Strip> cut_into_strips(const BucketLayout& buckets, const PixelRect& crop, int reach,
                                   int count);

/// Puts the pixels of the next strip below those of the strips before. `whole` may be empty.
void append_strip(Image&& strip, Image& whole);

}  // namespace tessera

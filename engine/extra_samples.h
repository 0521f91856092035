#pragma once
/// More samples for pixels in which the slopes of defocus have both signs: there the double wedge
/// is a box and no filter helps (L. Wu et al., "Multiple axis-aligned filters for rendering of
/// combined distribution effects", EGSR 2017, section 6.2).

#include <cstdint>
#include <memory>
#include <vector>

#include "cameras/camera.h"
#include "hide/hide.h"
#include "reconstruct/reconstruct.h"

namespace tessera {

/// The patterns that extra samples come from, by their number: a few steps, each with the samples
/// of a frame's own kind. Made once a frame.
class ExtraPatterns {
 public:
  /// `most`: extra samples of a pixel, at most.
  ExtraPatterns(int most, uint32_t seed, const LensProfile* lens, const ShutterProfile* shutter,
                SampleExtras extras);

  size_t steps() const { return patterns_.size(); }
  const SamplePattern& pattern(size_t step) const { return patterns_[step]; }
  /// The lowest step with at least `samples` samples, or the last.
  size_t step_for(double samples) const;

 private:
  std::vector<SamplePattern> patterns_;
};

/// For each pixel of the block, row-major, 1 + the step of extra samples that it gets, 0 for none:
/// a function of what its own samples see. Pixels whose nearest surfaces' circles of confusion have
/// both signs get what the sampling-rate bound asks for (reconstruct/sampling_rate.h).
std::vector<uint8_t> choose_extra(const SampleBlock& samples, const FragmentList& fragments,
                                  const Camera& camera, const ExtraPatterns& patterns);

/// The smallest rectangle that holds the pixels of `rect` with chosen[pixel] == choice.
PixelRect bounds_of(const std::vector<uint8_t>& chosen, const PixelRect& rect, uint8_t choice);

/// Removes the fragments of samples in pixels of `samples` that did not make `choice`; `chosen` is
/// over `rect`, which holds the block's.
void keep_chosen(const std::vector<uint8_t>& chosen, const PixelRect& rect, uint8_t choice,
                 const SampleBlock& samples, FragmentList& fragments);

/// Appends to each pixel of `values` with chosen[pixel] == choice its samples in `extra`, whose
/// rectangle lies within that of `values`.
void append_extra(const std::vector<uint8_t>& chosen, uint8_t choice, SampleValues&& extra,
                  SampleValues& values);

/// The pixels of `rect` with that choice as rectangles that do not overlap: rows of them, joined
/// where they have the same ends.
std::vector<PixelRect> parts_of(const std::vector<uint8_t>& chosen, const PixelRect& rect,
                                uint8_t choice);

/// Replaces all samples of the pixels of part.rect, which lies within values.rect.
void replace_part(SampleValues&& part, SampleValues& values);

/// Says for each pixel how many samples it has, so that others may have more: a sample counts for
/// as much in all buckets whatever their least number of samples.
SampleValues counted_by_pixel(SampleValues&& values);

}  // namespace tessera

#pragma once
/// What memo caches of several sizes would have to shade in one frame, for bench/shading.cpp. The
/// fragments of each bucket are asked for as a rasteriser meets them (K. Vaidyanathan et al.,
/// "Adaptive Image Space Shading for Motion and Defocus Blur", 2012, section 4): grid by grid, in
/// tiles of 8 x 8 pixels, in blocks of 2 x 2, and there pixel by pixel, all samples of each.

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "base/error.h"
#include "base/flat_index.h"
#include "bench/memo_cache.h"
#include "shade/shade.h"

namespace tessera {

/// Sizes of the caches that are replayed, entries. One without bounds comes beside them.
using CacheSizes = std::vector<size_t>;

/// Caches of all sizes fed by one stream of names.
class CacheBank {
 public:
  explicit CacheBank(const CacheSizes& sizes) : bounded_shaded_(sizes.size(), 0) {
    for (const size_t size : sizes) bounded_.emplace_back(size);
  }
  void replay(std::span<const uint64_t> names) {
    // What is asked for twice in a row is the newest entry of every cache: nothing changes.
    changes_.clear();
    for (const uint64_t name : names) {
      if (started_ && name == last_) continue;
      changes_.push_back(name);
      last_ = name, started_ = true;
    }
    for (size_t c = 0; c < bounded_.size(); ++c)
      for (const uint64_t name : changes_) bounded_shaded_[c] += bounded_[c].request(name);
    for (const uint64_t name : changes_) seen_.insert(name);
  }
  /// Of size `c` of those it was made with.
  uint64_t shaded(size_t c) const { return bounded_shaded_[c]; }
  uint64_t shaded_unbounded() const { return seen_.size(); }

 private:
  std::vector<MemoCache> bounded_;
  FlatIndex seen_;  ///< all names, which are hashes already
  std::vector<uint64_t> bounded_shaded_;
  uint64_t last_ = 0;
  bool started_ = false;
  std::vector<uint64_t> changes_;
};

/// Points and quads of one shading mode over a frame.
struct ModeReplay {
  std::string mode;
  CacheBank points, quads;
};

/// The samples of a bucket in a rasteriser's order.
inline std::vector<uint32_t> rasteriser_order(const SampleBlock& samples) {
  constexpr int tile = 8, block = 2;
  const int width = samples.rect.width(), height = samples.rect.height();
  const uint32_t spp = uint32_t(samples.samples_per_pixel);
  std::vector<uint32_t> order;
  order.reserve(samples.size());
  const auto add_pixel = [&](int x, int y) {
    if (x >= width || y >= height) return;
    const uint32_t first = uint32_t(y * width + x) * spp;
    for (uint32_t k = 0; k < spp; ++k) order.push_back(first + k);
  };
  for (int ty = 0; ty < height; ty += tile)
    for (int tx = 0; tx < width; tx += tile)
      for (int by = ty; by < ty + tile; by += block)
        for (int bx = tx; bx < tx + tile; bx += block)
          for (int pixel = 0; pixel < block * block; ++pixel)
            add_pixel(bx + pixel % block, by + pixel / block);
  return order;
}

/// The fragments of a bucket in a rasteriser's order.
inline std::vector<uint32_t> fragments_in_order(const ShadeInput& input) {
  const FragmentList& fragments = *input.fragments;
  std::vector<uint32_t> next(input.grids.size() + 1, 0);
  for (const uint32_t grid : fragments.grid) ++next[grid + 1];
  for (size_t g = 1; g < next.size(); ++g) next[g] += next[g - 1];
  std::vector<uint32_t> order(fragments.size());
  for (const uint32_t sample : rasteriser_order(*input.samples))
    for (uint32_t f = fragments.first_of_sample[sample]; f < fragments.first_of_sample[sample + 1];
         ++f)
      order[next[fragments.grid[f]]++] = f;
  return order;
}

/// Stands in for the frame's shading (FrameControl::make_shading): shades nothing, and tells the
/// caches what each of several modes asks for. For one thread.
class ReplayShading : public Shading {
 public:
  /// `replays` outlive the shading; their modes may differ from what the frame asks for.
  ReplayShading(const ShadingFrame& frame, std::span<ModeReplay> replays) : replays_(replays) {
    for (const ModeReplay& replay : replays) modes_.push_back(make_shading(replay.mode, frame));
  }

  void shade(const ShadeInput& input, ShadedFragments& out, ShadeCounters&) override {
    const std::vector<uint32_t> order = fragments_in_order(input);
    for (size_t m = 0; m < modes_.size(); ++m) {
      const AttachmentSwap mine(input.grids, m, modes_.size());
      points_.clear(), quads_.clear();
      for (const uint32_t f : order) {
        requests_.clear();
        modes_[m]->requests(input, f, requests_);
        for (const ShadingRequest& request : requests_) {
          points_.push_back(request.point);
          quads_.push_back(request.quad);
        }
      }
      replays_[m].points.replay(points_);
      replays_[m].quads.replay(quads_);
    }
    for (size_t c = 0; c < 3; ++c) {
      out.Ci[c].assign(input.fragments->size(), 0.0f);
      out.Oi[c].assign(input.fragments->size(), 1.0f);
    }
  }

  void requests(const ShadeInput&, size_t, std::vector<ShadingRequest>&) override {
    throw Error("a replay is asked for nothing");
  }

 private:
  /// A grid holds one attachment, and each mode believes it to be its own: while a mode is asked,
  /// its attachments are in place, and those of the others in here.
  struct ModeAttachments : GridAttachment {
    std::vector<std::unique_ptr<GridAttachment>> of_mode;
  };
  class AttachmentSwap {
   public:
    AttachmentSwap(std::span<const std::shared_ptr<const Grid>> grids, size_t mode, size_t modes)
        : grids_(grids), mode_(mode) {
      for (const auto& grid : grids_) {
        if (!grid->attachment) grid->attachment = std::make_unique<ModeAttachments>();
        auto& all = static_cast<ModeAttachments&>(*grid->attachment);
        all.of_mode.resize(modes);
        set_aside_.push_back(std::move(grid->attachment));
        grid->attachment = std::move(all.of_mode[mode]);
      }
    }
    ~AttachmentSwap() {
      for (size_t g = 0; g < grids_.size(); ++g) {
        auto& all = static_cast<ModeAttachments&>(*set_aside_[g]);
        all.of_mode[mode_] = std::move(grids_[g]->attachment);
        grids_[g]->attachment = std::move(set_aside_[g]);
      }
    }
    AttachmentSwap(const AttachmentSwap&) = delete;
    AttachmentSwap& operator=(const AttachmentSwap&) = delete;

   private:
    std::span<const std::shared_ptr<const Grid>> grids_;
    size_t mode_;
    std::vector<std::unique_ptr<GridAttachment>> set_aside_;
  };

  std::span<ModeReplay> replays_;
  std::vector<std::unique_ptr<Shading>> modes_;
  std::vector<ShadingRequest> requests_;
  std::vector<uint64_t> points_, quads_;
};

}  // namespace tessera

#include "reconstruct/pixel_facts.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <tbb/parallel_for.h>

namespace tessera {
namespace {

constexpr float unknown = std::numeric_limits<float>::quiet_NaN();

/// The displacements of a pixel's samples in one coordinate, as they come.
struct WedgeRange {
  std::array<float, 2> low{}, high{};
  bool any = false;

  void add(float x, float y) {
    if (!(std::isfinite(x) && std::isfinite(y))) return;
    const float shift[2] = {std::clamp(x, -PixelFacts::max_shift, PixelFacts::max_shift),
                            std::clamp(y, -PixelFacts::max_shift, PixelFacts::max_shift)};
    for (size_t a = 0; a < 2; ++a) {
      low[a] = any ? std::min(low[a], shift[a]) : shift[a];
      high[a] = any ? std::max(high[a], shift[a]) : shift[a];
    }
    any = true;
  }
  void store(WedgePlanes& planes, size_t pixel) const {
    if (!any) return;
    for (size_t a = 0; a < 2; ++a) planes.low[a][pixel] = low[a], planes.high[a][pixel] = high[a];
  }
};

/// Largest slope that is told apart from infinity.
constexpr float max_slope = 1e6f;

WedgeRange ray_wedge(const EffectValues& effect, size_t first, size_t end) {
  WedgeRange range;
  for (size_t s = first; s < end; ++s) {
    const float slope = std::min(effect.slope[s], max_slope);
    if (!(slope >= 0) || (effect.extent[0][s] == 0 && effect.extent[1][s] == 0)) continue;
    range.add(slope * effect.extent[0][s], slope * effect.extent[1][s]);
  }
  return range;
}

/// Shift per unit of the coordinate: `scale` times what the surfaces say.
WedgeRange surface_wedge(const std::array<std::vector<float>, 2>& shift, float scale,
                         const std::vector<uint32_t>& surface, size_t first, size_t end) {
  WedgeRange range;
  for (size_t s = first; s < end; ++s)
    if (surface.empty() || surface[s] != 0) range.add(scale * shift[0][s], scale * shift[1][s]);
  return range;
}

/// The value most of a range have, by the vote of Boyer and Moore; any of them without a majority.
uint32_t majority(const std::vector<uint32_t>& values, size_t first, size_t end) {
  uint32_t leader = 0;
  size_t lead = 0;
  for (size_t s = first; s < end; ++s) {
    if (lead == 0) leader = values[s];
    lead = values[s] == leader ? lead + 1 : lead - 1;
  }
  return leader;
}

size_t first_sample(const SampleValues& values, size_t pixel) {
  return values.first_of_pixel.empty() ? pixel * size_t(values.samples_per_pixel)
                                       : values.first_of_pixel[pixel];
}

void store_normal(const SampleSurfaces& surfaces, size_t first, size_t end, PixelFacts& facts,
                  size_t pixel) {
  if (surfaces.N[0].empty()) return;
  float sum[3] = {};
  for (size_t s = first; s < end; ++s)
    for (size_t a = 0; a < 3; ++a) sum[a] += surfaces.N[a][s];
  const float length = std::sqrt(sum[0] * sum[0] + sum[1] * sum[1] + sum[2] * sum[2]);
  if (!(length > 1e-6f) || !std::isfinite(length)) return;
  for (size_t a = 0; a < 3; ++a) facts.N[a][pixel] = sum[a] / length;
}

}  // namespace

float WedgePlanes::sure_shift(size_t pixel) const {
  if (!known(pixel)) return 0;
  float squares = 0;
  for (size_t a = 0; a < 2; ++a) {
    const float least = std::max({low[a][pixel], -high[a][pixel], 0.0f});
    squares += least * least;
  }
  return std::sqrt(squares);
}

BlurLine blur_line(const WedgePlanes& planes, size_t pixel) {
  BlurLine line;
  const AxisWedge x = planes.axis(0, pixel), y = planes.axis(1, pixel);
  const float mx = 0.5f * (x.low + x.high), my = 0.5f * (y.low + y.high);
  const float length = std::sqrt(mx * mx + my * my);
  if (!(length > 0)) return line;
  line.dx = mx / length, line.dy = my / length;
  const auto along = [](float scale, const AxisWedge& w) {
    const float a = scale * w.low, b = scale * w.high;
    return AxisWedge{std::min(a, b), std::max(a, b)};
  };
  const AxisWedge wx = along(line.dx, x), wy = along(line.dy, y);
  line.wedge = {wx.low + wy.low, wx.high + wy.high};
  return line;
}

PixelFacts::PixelFacts(const PixelRect& rect, const DistributionFeatures& features) : rect_(rect) {
  const size_t pixels = size_t(rect.pixel_count());
  const bool present[blur_count] = {features.shadow, features.bounce, features.lens,
                                    features.motion};
  for (size_t b = 0; b < blur_count; ++b)
    if (present[b])
      for (auto* ends : {&wedges[b].low, &wedges[b].high})
        for (std::vector<float>& axis : *ends) axis.assign(pixels, unknown);
  for (std::vector<float>& axis : N) axis.assign(pixels, 0.0f);
  surface.assign(pixels, 0);
  samples.assign(pixels, 0.0f);
}

void PixelFacts::add(const SampleValues& values, const SampleSpreads& spreads) {
  const DistributionSamples& d = values.distribution;
  size_t p = 0;
  for (int y = values.rect.y0; y < values.rect.y1; ++y) {
    for (int x = values.rect.x0; x < values.rect.x1; ++x, ++p) {
      if (!rect_.contains(x, y)) continue;
      const size_t first = first_sample(values, p), end = first_sample(values, p + 1);
      const size_t at = index(x, y);
      for (size_t e = 0; e < ray_effect_count; ++e)
        if (!wedges[e].empty() && !d.effects[e].empty())
          ray_wedge(d.effects[e], first, end).store(wedges[e], at);
      const SampleSurfaces& s = d.surfaces;
      // f(x, u) = g(x - coc u) with u = extent * y; f(x, t) = g(x - velocity t) with t = (1 + y)/2.
      if (!wedges[size_t(Blur::lens)].empty() && !s.coc[0].empty())
        surface_wedge(s.coc, -spreads.lens, s.surface, first, end)
            .store(wedges[size_t(Blur::lens)], at);
      if (!wedges[size_t(Blur::motion)].empty() && !s.velocity[0].empty())
        surface_wedge(s.velocity, -spreads.time, s.surface, first, end)
            .store(wedges[size_t(Blur::motion)], at);
      store_normal(s, first, end, *this, at);
      if (!s.surface.empty()) surface[at] = majority(s.surface, first, end);
      samples[at] = float(end - first);
    }
  }
}

namespace {

/// Averages one coordinate's wedges around pixel (x, y) of `facts`.
void smooth_wedge(const PixelFacts& facts, Blur blur, int x, int y, WedgePlanes& out, size_t at) {
  const WedgePlanes& in = facts.wedges[size_t(blur)];
  const uint32_t own = facts.surface[facts.index(x, y)];
  const PixelRect near =
      PixelRect{x, y, x + 1, y + 1}.grown(facts_smoothing_reach).intersect(facts.rect());
  std::array<float, 2> low{}, high{};
  int count = 0;
  for (int qy = near.y0; qy < near.y1; ++qy) {
    for (int qx = near.x0; qx < near.x1; ++qx) {
      const size_t q = facts.index(qx, qy);
      if (!in.known(q) || (of_rays(blur) && facts.surface[q] != own)) continue;
      for (size_t a = 0; a < 2; ++a) low[a] += in.low[a][q], high[a] += in.high[a][q];
      ++count;
    }
  }
  if (count == 0) return;
  for (size_t a = 0; a < 2; ++a)
    out.low[a][at] = low[a] / float(count), out.high[a][at] = high[a] / float(count);
}

}  // namespace

PixelFacts smoothed(const PixelFacts& facts, const PixelRect& rect) {
  DistributionFeatures features;
  features.shadow = !facts.wedges[size_t(Blur::shadow)].empty();
  features.bounce = !facts.wedges[size_t(Blur::bounce)].empty();
  features.lens = !facts.wedges[size_t(Blur::lens)].empty();
  features.motion = !facts.wedges[size_t(Blur::motion)].empty();
  PixelFacts out(rect, features);
  tbb::parallel_for(rect.y0, rect.y1, [&](int y) {
    for (int x = rect.x0; x < rect.x1; ++x) {
      const size_t from = facts.index(x, y), at = out.index(x, y);
      for (size_t a = 0; a < 3; ++a) out.N[a][at] = facts.N[a][from];
      out.surface[at] = facts.surface[from];
      out.samples[at] = facts.samples[from];
      for (size_t b = 0; b < blur_count; ++b)
        if (!out.wedges[b].empty()) smooth_wedge(facts, Blur(b), x, y, out.wedges[b], at);
    }
  });
  return out;
}

}  // namespace tessera

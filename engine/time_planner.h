#pragma once
/// How many samples a frame has time for. Knows neither frames nor clocks: it is told what passes
/// took.

#include <optional>

namespace tessera {

/// A pass with as many samples in every pixel.
struct TimedPass {
  int samples = 0;       ///< a pixel
  double seconds = 0;    ///< what it took
  double elapsed_s = 0;  ///< since the frame began, at its end
};

/// Each pass tells what the next may cost: the first takes the fewest samples there are, those that
/// follow take shares of the time left. What a pass costs besides its samples counts as if it were
/// for them, so passes come out short rather than long, and a further one fills the rest.
class TimePlanner {
 public:
  /// `reserve_s`: what is left to do after the last pass. Passes have multiples of `unit` samples a
  /// pixel, together at most `most`.
  TimePlanner(double time_s, double reserve_s, int unit, int most)
      : time_s_(time_s), reserve_s_(reserve_s), unit_(unit), most_(most) {}

  int first_samples() const { return unit_; }
  /// Samples of the next pass; null: it was enough.
  std::optional<int> next(const TimedPass& last);

 private:
  double time_s_, reserve_s_;
  int unit_, most_;
  int passes_ = 0, samples_ = 0;
};

/// Whether a pass has so many more samples than all before it together, `before`, that their few
/// would only harm its image: few samples are badly stratified.
bool replaces_what_was_before(int samples, int before);

}  // namespace tessera

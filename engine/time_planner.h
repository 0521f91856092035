#pragma once
/// How many samples a frame has time for. Knows neither frames nor clocks: it is told what passes
/// took.

#include <optional>
#include <vector>

namespace tessera {

/// A pass with as many samples in every pixel.
struct TimedPass {
  int samples = 0;       ///< a pixel
  double seconds = 0;    ///< what it took
  double elapsed_s = 0;  ///< since the frame began, at its end
  /// What it took of each thread's core; fewer than `seconds` where threads waited for a core or
  /// for each other. 0: not known.
  double core_s = 0;
  double filter_s = 0;  ///< of `seconds`, for filtering the image: whatever its samples
  double dice_s = 0;    ///< of `seconds`, for dicing, which further passes need not repeat
};

/// A few small passes tell what one costs, then a large one takes the time that is left: samples
/// that are placed together are better stratified, and better filtered, than as many in two passes.
///
/// A pass is taken to cost a + b * samples seconds of a core, whatever else the machine is doing.
/// Each pass bounds b; two of very different samples tell both. The first, with the fewest samples
/// there are, shades what the others find ready, so a third may be needed to be sure. The cores
/// that passes had lately tell how long it takes. Where threads waited for cores, some of the time
/// is kept for another large pass, by what the first has told.
class TimePlanner {
 public:
  /// `reserve_s`: what is left to do after the last pass. Passes have multiples of `unit` samples a
  /// pixel, together at most `most`.
  TimePlanner(double time_s, double reserve_s, int unit, int most)
      : time_s_(time_s), reserve_s_(reserve_s), unit_(unit), most_(most) {}

  int first_samples() const { return unit_; }
  /// Samples of the next pass; null: it was enough.
  std::optional<int> next(const TimedPass& last);
  /// After the end: `most` samples ended it, and there was time for more.
  bool samples_spent() const { return samples_spent_; }

 private:
  /// Core seconds of a pass.
  struct Cost {
    double fixed_s = 0, sample_s = 0;
    bool sure = false;  ///< false: a further small pass would tell more
  };

  Cost cost() const;
  double cores_had() const;
  double affordable(double seconds, const Cost& cost) const;
  double wanted_samples(double left_s, const Cost& cost) const;

  double time_s_, reserve_s_;
  int unit_, most_;
  int samples_ = 0;
  bool samples_spent_ = false;
  std::vector<TimedPass> passes_;
};

/// Whether a pass has so many more samples than all before it together, `before`, that their few
/// would only harm its image: few samples are badly stratified, and where images are `filtered`
/// they are blurred besides, which their mean keeps.
bool replaces_what_was_before(int samples, int before, bool filtered);

}  // namespace tessera

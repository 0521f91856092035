#pragma once
/// How far a frame is, as text: a bar with the time left on a terminal, a few plain lines
/// elsewhere.

#include <optional>
#include <string>

namespace tessera {

/// "0:07", "12:30", "3:04:05".
std::string format_duration(double seconds);

/// How far a frame is.
struct FrameProgress {
  int pass = 1;                             ///< the one under way, from 1
  int passes = 1;                           ///< 0: not known yet
  int buckets_done = 0, buckets_total = 0;  ///< of the pass
};

/// Decides what to print and when. Knows neither clock nor stream: both are the caller's, so that
/// it can be tested.
class ProgressMeter {
 public:
  /// `columns`: width of the terminal; used with `terminal` only.
  ProgressMeter(std::string label, bool terminal, int columns)
      : label_(std::move(label)), terminal_(terminal), columns_(columns) {}

  /// What to print now, if anything. On a terminal: the bar, from the start of the line, without a
  /// line end, at most ten times a second and at the end. Otherwise: one line for each 10% at most,
  /// and of passes after the first not more than one in two seconds. The time left is that of the
  /// pass, by what it has taken since it was first heard of.
  std::optional<std::string> update(const FrameProgress& progress, double elapsed_s);

 private:
  std::optional<std::string> update_bar(const FrameProgress& progress, double elapsed_s);
  std::optional<std::string> update_lines(const FrameProgress& progress, double elapsed_s);
  std::string label(const FrameProgress& progress) const;
  std::string time_left(const FrameProgress& progress, double elapsed_s) const;

  std::string label_;
  bool terminal_;
  int columns_;
  int pass_ = 0;
  double pass_start_s_ = 0, next_redraw_s_ = 0, next_line_s_ = 0;
  int tenths_said_ = 0;
};

/// What wipes a bar off the terminal.
inline constexpr const char* clear_progress_bar = "\r\x1b[K";

}  // namespace tessera

#pragma once
/// How far a frame is, as text: a bar with the time left on a terminal, a few plain lines
/// elsewhere.

#include <optional>
#include <string>

namespace tessera {

/// "0:07", "12:30", "3:04:05".
std::string format_duration(double seconds);

/// Decides what to print and when. Knows neither clock nor stream: both are the caller's, so that
/// it can be tested.
class ProgressMeter {
 public:
  /// `columns`: width of the terminal; used with `terminal` only.
  ProgressMeter(std::string label, bool terminal, int columns)
      : label_(std::move(label)), terminal_(terminal), columns_(columns) {}

  /// What to print now, if anything. On a terminal: the bar, from the start of the line, without a
  /// line end, at most ten times a second and at the end. Otherwise: one line for each 10% at most.
  std::optional<std::string> update(int done, int total, double elapsed_s);

 private:
  std::optional<std::string> update_bar(int done, int total, double elapsed_s);
  std::optional<std::string> update_lines(int done, int total, double elapsed_s);

  std::string label_;
  bool terminal_;
  int columns_;
  double next_redraw_s_ = 0;
  int tenths_said_ = 0;
};

/// What wipes a bar off the terminal.
inline constexpr const char* clear_progress_bar = "\r\x1b[K";

}  // namespace tessera

#include "engine/progress.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace tessera {
namespace {

constexpr double redraw_interval_s = 0.1;

/// Passes may be many and short, and logs should not be.
constexpr double line_interval_s = 2;

}  // namespace

std::string format_duration(double seconds) {
  const long whole = std::lround(std::clamp(seconds, 0.0, 1e9));
  const long minutes = whole / 60 % 60, hours = whole / 3600;
  if (hours > 0) return fmt::format("{}:{:02}:{:02}", hours, minutes, whole % 60);
  return fmt::format("{}:{:02}", minutes, whole % 60);
}

std::optional<std::string> ProgressMeter::update(const FrameProgress& progress, double elapsed_s) {
  if (progress.buckets_total <= 0) return std::nullopt;
  if (progress.pass != pass_) {
    pass_ = progress.pass;
    pass_start_s_ = elapsed_s, next_redraw_s_ = 0, tenths_said_ = 0;
  }
  return terminal_ ? update_bar(progress, elapsed_s) : update_lines(progress, elapsed_s);
}

std::optional<std::string> ProgressMeter::update_bar(const FrameProgress& progress,
                                                     double elapsed_s) {
  const int done = progress.buckets_done, total = progress.buckets_total;
  if (done < total && elapsed_s < next_redraw_s_) return std::nullopt;
  next_redraw_s_ = elapsed_s + redraw_interval_s;
  const std::string start = label(progress);
  const std::string end =
      fmt::format(" {:3}%  {}", 100L * done / total, time_left(progress, elapsed_s));
  // Label, blank, brackets and the text after the bar; what is left is the bar.
  const int room = columns_ - int(start.size() + 3 + end.size()) - 1;
  const int width = std::clamp(room, 0, 40);
  const int filled = int(long(width) * done / total);
  return fmt::format("{}{} [{:#<{}}{:.<{}}]{}", clear_progress_bar, start, "", filled, "",
                     width - filled, end);
}

std::optional<std::string> ProgressMeter::update_lines(const FrameProgress& progress,
                                                       double elapsed_s) {
  const int tenths = int(10L * progress.buckets_done / progress.buckets_total);
  if (tenths <= tenths_said_ || (pass_ > 1 && elapsed_s < next_line_s_)) return std::nullopt;
  tenths_said_ = tenths;
  next_line_s_ = elapsed_s + line_interval_s;
  return fmt::format("{}: {}%, {}\n", label(progress), 10 * tenths, time_left(progress, elapsed_s));
}

std::string ProgressMeter::label(const FrameProgress& progress) const {
  if (progress.passes == 1) return label_;
  const std::string of = progress.passes > 0 ? fmt::format(" of {}", progress.passes) : "";
  return fmt::format("{}, pass {}{}", label_, progress.pass, of);
}

/// From the share of the buckets that is done; buckets differ, so it is a guess that improves.
std::string ProgressMeter::time_left(const FrameProgress& progress, double elapsed_s) const {
  const int done = progress.buckets_done;
  if (done == 0) return "";
  const double left_s = (elapsed_s - pass_start_s_) * (progress.buckets_total - done) / done;
  return format_duration(left_s) + (progress.passes == 1 ? " left" : " left of the pass");
}

}  // namespace tessera

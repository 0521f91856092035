#include "engine/progress.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace tessera {
namespace {

constexpr double redraw_interval_s = 0.1;

/// From the share of the buckets that is done; buckets differ, so it is a guess that improves.
std::string time_left(int done, int total, double elapsed_s) {
  if (done == 0) return "";
  return format_duration(elapsed_s * (total - done) / done) + " left";
}

}  // namespace

std::string format_duration(double seconds) {
  const long whole = std::lround(std::clamp(seconds, 0.0, 1e9));
  const long minutes = whole / 60 % 60, hours = whole / 3600;
  if (hours > 0) return fmt::format("{}:{:02}:{:02}", hours, minutes, whole % 60);
  return fmt::format("{}:{:02}", minutes, whole % 60);
}

std::optional<std::string> ProgressMeter::update(int done, int total, double elapsed_s) {
  if (total <= 0) return std::nullopt;
  return terminal_ ? update_bar(done, total, elapsed_s) : update_lines(done, total, elapsed_s);
}

std::optional<std::string> ProgressMeter::update_bar(int done, int total, double elapsed_s) {
  if (done < total && elapsed_s < next_redraw_s_) return std::nullopt;
  next_redraw_s_ = elapsed_s + redraw_interval_s;
  const std::string end =
      fmt::format(" {:3}%  {}", 100L * done / total, time_left(done, total, elapsed_s));
  // Label, blank, brackets and the text after the bar; what is left is the bar.
  const int room = columns_ - int(label_.size() + 3 + end.size()) - 1;
  const int width = std::clamp(room, 0, 40);
  const int filled = int(long(width) * done / total);
  return fmt::format("{}{} [{:#<{}}{:.<{}}]{}", clear_progress_bar, label_, "", filled, "",
                     width - filled, end);
}

std::optional<std::string> ProgressMeter::update_lines(int done, int total, double elapsed_s) {
  const int tenths = int(10L * done / total);
  if (tenths <= tenths_said_) return std::nullopt;
  tenths_said_ = tenths;
  return fmt::format("{}: {}%, {}\n", label_, 10 * tenths, time_left(done, total, elapsed_s));
}

}  // namespace tessera

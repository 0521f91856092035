#include "engine/accuracy_target.h"

#include <fmt/format.h>

#include "base/diagnostics.h"
#include "engine/limits.h"
#include "engine/settings.h"

namespace tessera {
namespace {

constexpr double late = 1.1;  // of the time given: worth a warning

void check_above_0(const char* what, double value, double high) {
  if (!(value > 0) || value > high)
    throw Error(fmt::format("{} must be above 0 and at most {}, found {}", what, high, value));
}

}  // namespace

AccuracyTarget accuracy_target(const Settings& settings) {
  AccuracyTarget target;
  target.error = settings.error, target.time_s = settings.time_s;
  if (settings.max_samples) target.max_samples = *settings.max_samples;
  if (!target.error && !target.time_s && settings.max_samples)
    throw Error("a limit of the samples needs an error or a time that they are limited for");
  if (settings.samples_per_pixel && (target.error || target.time_s))
    throw Error(
        "samples per pixel are found by the error or the time that is asked for; expected one of "
        "them, not both");
  target.rounds = settings.rounds;
  if (!target.rounds.empty() && (target.error || target.time_s || settings.samples_per_pixel))
    throw Error("rounds repeat a frame; expected no error, time or samples per pixel besides");
  target.passes = settings.passes;
  if (!target.passes.empty() &&
      (target.error || target.time_s || !target.rounds.empty() || settings.samples_per_pixel))
    throw Error("passes repeat a frame; expected no error, time, rounds or samples per pixel too");
  for (const int samples : target.passes)
    check_above_0("samples of a pass", samples, max_samples_per_pixel);
  for (const double samples : target.rounds)
    check_above_0("samples of a round", samples, max_samples_per_pixel);
  if (target.error) check_above_0("error", *target.error, max_error);
  if (target.time_s) check_above_0("time in seconds", *target.time_s, max_time_s);
  if (target.max_samples < 2 || target.max_samples > max_samples_per_pixel)
    throw Error(fmt::format("the limit of samples per pixel must lie between 2 and {}, found {}",
                            max_samples_per_pixel, target.max_samples));
  return target;
}

void warn_if_late(const AccuracyTarget& target, double elapsed_s, double samples,
                  Diagnostics& diagnostics) {
  if (!target.time_s || elapsed_s <= late * *target.time_s) return;
  diagnostics.warn_once("time target",
                        fmt::format("the frame took {:.3g} s rather than {:.3g} s, with {:.4g} "
                                    "samples a pixel",
                                    elapsed_s, *target.time_s, samples));
}

}  // namespace tessera

#pragma once
/// Numbered files: `shot.####.rib` with a range of frames, and names that take a frame's number.

#include <string>
#include <string_view>
#include <vector>

namespace tessera {

/// "A", "A-B" or "A-BxS" (every S-th) -> the frame numbers in ascending order. Throws Error that
/// says what was expected; a range holds at most a million frames.
std::vector<int> parse_frame_range(std::string_view text);

/// Whether `name` holds a place for a frame number: a run of '#'.
bool has_number_pattern(std::string_view name);

/// Replaces every run of '#' by the number, with zeros in front to the length of the run.
std::string with_number(std::string_view pattern, int number);

/// Puts ".NNNN" before the extension: "out.exr", 7 -> "out.0007.exr".
std::string insert_number(std::string_view name, int number);

}  // namespace tessera

#pragma once
/// The folder that a sweep writes to.

#include <string>

namespace tessera::trade {

/// Makes the folder with all that is above it, and its folder of images. `fresh`: forgets the sweep
/// that it holds. Throws Error where it cannot be written, and where it holds runs and neither
/// `resume` nor `fresh` says what is to become of them.
void prepare_folder(const std::string& output, bool resume, bool fresh);

}  // namespace tessera::trade

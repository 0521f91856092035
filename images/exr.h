#pragma once
/// OpenEXR files.

#include <string>

#include "images/image.h"

namespace tessera {

/// Writes every channel of `image`, with its windows, metadata (as string attributes) and matrices,
/// through a temporary file: `path` is either complete or untouched. Values beyond the range of a
/// half channel are written as +-65504; NaN stays NaN. Throws Error when the image is empty, two
/// channels share a name, or writing fails, a full disc included.
void write_exr(const std::string& path, const Image& image);

/// Reads the first part of an OpenEXR file, whatever its channels and their types. Throws Error if
/// it cannot be read, is incomplete, subsamples a channel, or claims more than 2^31 values.
Image read_exr(const std::string& path);

}  // namespace tessera

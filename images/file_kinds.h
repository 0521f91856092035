#pragma once
/// What kind of picture a file is, by its name or by what it begins with.

#include <string>

namespace tessera {

/// The extension of `path` in lower case, with its dot; empty when there is none.
std::string lower_extension(const std::string& path);

/// Whether a file of that name is an EXR: ".exr" in any case.
bool named_exr(const std::string& path);

/// Whether a file of that name has 8 bits a channel, sRGB code values: PNG and JPEG.
bool named_8_bit(const std::string& path);

/// Throws Error unless a picture can be written under that name: EXR, PNG, JPEG or TIFF.
void check_format(const std::string& path);

/// Whether the file begins as an EXR does, whatever its name. False when it cannot be read.
bool holds_exr(const std::string& path);

}  // namespace tessera

#pragma once
/// Pixels as text that a browser decodes without a library: numbers arranged so that deflate finds
/// what repeats, zlib, base64.

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "images/image.h"

namespace tessera {

/// An image ready to be put into a page.
struct EncodedImage {
  int width = 0, height = 0;
  std::string text;  ///< base64 (RFC 4648) of a zlib stream (RFC 1950) of the bytes below
};

/// R, G and B of `image` as half floats: 11 significant bits, an error of at most 2^-11 of a value,
/// or of 2^-25 where that is more. Values beyond +-65504 are kept as that; NaN and infinities stay.
///
/// Bytes: with n pixels, row after row, three planes G, R - G and B - G of 16-bit differences of
/// the bits of the halves, modulo 2^16; each entry of a plane less the one before it, the first
/// less 0. Of each plane first the n high bytes, then the n low bytes. Grey noise, which is most of
/// what an image holds at few samples, is then in one plane of three. Throws Error without R, G and
/// B.
EncodedImage encode_colour(const Image& image);

/// One channel as 32-bit floats, exactly. Bytes: the n highest bytes, then the next, ... the
/// lowest, so that small counts leave two of four planes empty.
EncodedImage encode_scalar(const Image& image, std::string_view channel);

/// RFC 4648 section 4, padded, in one line.
std::string base64(std::span<const uint8_t> bytes);

}  // namespace tessera

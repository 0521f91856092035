#pragma once
/// Which differences of two images a viewer would see.

#include "images/image.h"

namespace tessera {

/// How pictures are looked at.
struct ViewingConditions {
  float white_cd_per_m2 = 100.0f;  ///< luminance of the value 1
  float width_degrees = 45.0f;     ///< what the picture's width takes of the field of view
};

/// Whether both have channels R, G and B.
bool have_colors(const Image& a, const Image& b);

/// Share of the pixels, in [0, 1], where a viewer would see that `a` is not `b`: those that fail
/// the metric of H. Yee and A. Newman, "A Perceptual Metric for Production Testing" (SIGGRAPH
/// sketches, 2004). A difference in luminance is seen when it exceeds the threshold of the eye
/// adapted to the degree around it (G. Ward Larson, H. Rushmeier, C. Piatko, 1997), raised by up to
/// 10 where fine detail is little sensed (P. Barten, 1989) or masks it (S. Daly, 1993); one in
/// colour when a* and b* of CIELAB are more than that factor's root apart, less in the dark.
///
/// R, G and B are linear, with the primaries of sRGB; negative values count as 0. A pixel with a
/// value that is not finite is seen unless it is the same in both. Throws Error when the data
/// windows differ, are empty, or an image lacks one of the channels.
double visible_share(const Image& a, const Image& b, const ViewingConditions& viewing = {});

}  // namespace tessera

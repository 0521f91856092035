#pragma once
/// Hiders that rasterise the bucket's grids once for each of a few fixed tuples (u, v, t): the
/// method compared with in Laine et al. 2011, section 2, as InterleaveUVT (Fatahalian et al. 2009),
/// and the accumulation buffer (Haeberli and Akeley 1990) before it.

#include "hide/hide.h"

namespace tessera {

/// `name` is the hider's and `arguments` what follows its colon: the number of tuples, or nothing
/// for as many as samples of that kind allow. Throws Error on anything else.
std::unique_ptr<Hider> make_tuple_hider(std::string_view name, SampleTuples::Kind kind,
                                        std::string_view arguments);

}  // namespace tessera

#pragma once
/// Which runs no other run beats.

#include <span>
#include <vector>

#include "trade/measurement.h"

namespace tessera::trade {

/// Two things of which less is better.
struct Costs {
  double time_s = 0, error = 0;
};

/// Whether each is on the front: no other is at most as large in both and less in one. Equal ones
/// are on it together or not at all. What is not a number is never on it.
std::vector<bool> pareto_front(std::span<const Costs> points);

/// Sets Run::pareto, of frame time against relMSE, among those that went well.
void mark_front(std::vector<Run>& runs);

}  // namespace tessera::trade

#pragma once
/// What a sweep says about the scene, in sentences.

#include <string>
#include <vector>

#include "trade/measurement.h"

namespace tessera::trade {

struct WordsInput {
  const std::vector<Run>& runs;
  std::vector<Turn> turns;  ///< swept, the default left out
  int pivot_spp = 16;       ///< samples per pixel at which others are compared with the default
  double reference_rel_mse = unknown;  ///< the reference's own error
};

/// What samples buy; which knob buys most; what each other value costs or buys; what limits the
/// answer.
std::vector<std::string> describe_trade(const WordsInput& input);

}  // namespace tessera::trade

#pragma once
/// Which reference a sweep takes: a given one, that of before, or one that its budget can afford.

#include <functional>
#include <string>
#include <vector>

#include "trade/command_line.h"
#include "trade/reference.h"

namespace tessera::trade {

struct ReferenceSearch {
  const TradeOptions& options;
  std::string scene_hash;
  int usual_spp = 0;      ///< for both halves together, where neither user nor budget say
  std::string kept_hash;  ///< of the pixels of the reference of before; empty: there is none
  std::function<double()> left_s;               ///< of the budget
  std::function<void(const std::string&)> say;  ///< told what is being done
};

/// Takes the reference that is given; or, of a sweep that goes on and asks for none, that of before
/// in its folder, whatever the budget is now; or renders one, whose samples are halved until it is
/// predicted to take at most a third of the budget. `notes` get what a budget changed. Throws Error
/// when there is no reference.
Reference find_reference(const Renderer& renderer, const ReferenceSearch& search,
                         std::vector<std::string>& notes);

}  // namespace tessera::trade

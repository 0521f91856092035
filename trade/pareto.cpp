#include "trade/pareto.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace tessera::trade {

std::vector<bool> pareto_front(std::span<const Costs> points) {
  std::vector<size_t> order;
  for (size_t i = 0; i < points.size(); ++i)
    if (!std::isnan(points[i].time_s) && !std::isnan(points[i].error)) order.push_back(i);
  std::sort(order.begin(), order.end(), [&points](size_t a, size_t b) {
    const Costs &p = points[a], &q = points[b];
    return p.time_s != q.time_s ? p.time_s < q.time_s : p.error < q.error;
  });
  std::vector<bool> front(points.size(), false);
  double least_error = std::numeric_limits<double>::infinity(), its_time_s = 0;
  bool any = false;
  for (const size_t i : order) {
    const Costs& point = points[i];
    const bool better = !any || point.error < least_error;
    const bool equal = any && point.error == least_error && point.time_s == its_time_s;
    front[i] = better || equal;
    if (!better) continue;
    any = true;
    least_error = point.error;
    its_time_s = point.time_s;
  }
  return front;
}

void mark_front(std::vector<Run>& runs) {
  std::vector<Costs> points;
  for (const Run& run : runs)
    points.push_back(run.ok() ? Costs{run.result.frame_s, run.result.rel_mse}
                              : Costs{unknown, unknown});
  const std::vector<bool> front = pareto_front(points);
  for (size_t i = 0; i < runs.size(); ++i) runs[i].pareto = front[i];
}

}  // namespace tessera::trade

#include "reconstruct/wedge_spectrum.h"

#include <cmath>
#include <numbers>

#include "reconstruct/maaf_components.h"
#include "reconstruct/quadrature.h"

namespace tessera {
namespace {

double value(const std::vector<SpectrumGaussian>& filter, double x, double y) {
  double sum = 0.0;
  for (const SpectrumGaussian& g : filter) {
    const double a = (x - g.x - g.shear * (y - g.y)) / g.x_deviation, b = (y - g.y) / g.y_deviation;
    sum += g.weight * std::exp(-0.5 * (a * a + b * b));
  }
  return sum;
}

double whole_integral(const std::vector<SpectrumGaussian>& filter) {
  double sum = 0.0;
  for (const SpectrumGaussian& g : filter)
    sum += 2.0 * std::numbers::pi * g.weight * g.x_deviation * g.y_deviation;
  return sum;
}

/// Over both halves of the wedge, of a function with f(-x, -y) = f(x, y).
template <class Function>
double wedge_integral(const DoubleWedge& wedge, const Function& f) {
  constexpr int panels = 4;
  return 2.0 * gauss_integral(0.0, 1.0, panels, [&](double y) {
           return gauss_integral(y / wedge.s_max, y / wedge.s_min, panels,
                                 [&](double x) { return f(x, y); });
         });
}

}  // namespace

std::vector<SpectrumGaussian> aaf_spectrum(const DoubleWedge& wedge) {
  return {{1.0, 0.0, 0.0, 1.0 / wedge.s_min, 1.0}};
}

std::vector<SpectrumGaussian> fsf_spectrum(const DoubleWedge& wedge) {
  const double near = 1.0 / wedge.s_min, far = 1.0 / wedge.s_max;
  return {{1.0, 0.0, 0.0, 0.5 * (near - far), 1.0, 0.5 * (near + far)}};
}

std::vector<SpectrumGaussian> maaf_spectrum(const DoubleWedge& wedge, int components) {
  std::vector<SpectrumGaussian> filter;
  for (int p = 0; 2 * p < components; ++p) {
    const MaafComponent component{p, components, 1.0};
    const Band x = component.along_x(wedge.s_min, wedge.s_max), y = component.along_y();
    filter.push_back({1.0, x.centre, y.centre, x.deviation, y.deviation});
    if (p > 0) filter.push_back({1.0, -x.centre, -y.centre, x.deviation, y.deviation});
  }
  return filter;
}

WedgeFit gaussian_fit(const DoubleWedge& wedge, const std::vector<SpectrumGaussian>& filter) {
  const double inside =
      wedge_integral(wedge, [&](double x, double y) { return value(filter, x, y); });
  const double squares = wedge_integral(wedge, [&](double x, double y) {
    const double difference = value(filter, x, y) - 1.0;
    return difference * difference;
  });
  return {inside / whole_integral(filter), 1.0 - std::sqrt(squares / wedge.area())};
}

double box_coverage(const DoubleWedge& wedge, int components) {
  double area = 0.0;
  for (const SpectrumGaussian& box : maaf_spectrum(wedge, components))
    area += 4.0 * box.x_deviation * box.y_deviation;
  return wedge.area() / area;
}

}  // namespace tessera

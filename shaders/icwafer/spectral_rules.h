/* SPDX-License-Identifier: Apache-2.0 */

/* Quadrature rules over the visible spectrum (host only): the few wavelengths, and their weights in
 * red, green and blue, from which a reflectance that varies slowly gets its colour.
 *
 * What a film does to light varies with the wavenumber 1 / lambda as a sum of cos and sin of
 * 2 pi X / lambda, X up to a few times the light's path there and back. The nodes are quantiles of
 * a density that is for the most part uniform in the wavenumber, and otherwise the sensitivities
 * under the lamp, so that they gather at its lines. The weights are the non-negative least squares
 * solution for the integrals of these functions, so nothing that is positive ever gets a negative
 * colour; they add up to 1, so a flat reflectance is exactly white. */

#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "colour_table.h"

namespace icwafer {

struct SpectralRule {
  std::vector<double> wavelength_nm;
  /* For red, green, blue. */
  std::array<std::vector<double>, 3> weight;
};

namespace spectral_rule_detail {

/* Where the part of the nodes that is uniform in the wavenumber begins and ends, and how much that
 * is of all. */
constexpr double begin_nm = 410.0, end_nm = 710.0, uniform_part = 0.7;
/* Steps between the paths X that a rule is fitted at, and how much more X = 0 counts. */
constexpr double path_step_nm = 100.0, flat_importance = 30.0;
constexpr int descent_rounds = 800;

/* Wavelengths at (k + 1/2) / count of the cumulative density. */
inline std::vector<double> quantiles(const ColourTable &sensitivities, const int count)
{
  std::array<double, visible_count> density;
  double seen = 0.0;
  for (int i = 0; i < visible_count; i++) {
    const auto &s = sensitivities[i];
    density[i] = std::max({s[0], s[1], s[2]});
    seen += density[i];
  }
  for (int i = 0; i < visible_count; i++) {
    const double nm = visible_first_nm + i;
    density[i] *= (1.0 - uniform_part) / seen;
    if (nm >= begin_nm && nm <= end_nm) {
      density[i] += uniform_part / (nm * nm * (1.0 / begin_nm - 1.0 / end_nm));
    }
  }
  double sum = 0.0;
  for (const double x : density) {
    sum += x;
  }
  std::vector<double> nodes;
  double below = 0.0;
  for (int i = 0; i < visible_count; i++) {
    const double above = below + density[i] / sum;
    while (int(nodes.size()) < count && (double(nodes.size()) + 0.5) / count <= above) {
      const double part = ((double(nodes.size()) + 0.5) / count - below) / (above - below);
      nodes.push_back(visible_first_nm + i + std::min(part, 1.0) - 0.5);
    }
    below = above;
  }
  return nodes;
}

/* The x >= 0 that minimises x G x / 2 - c x, by descent along one coordinate after the other. */
inline std::vector<double> descend(const std::vector<std::vector<double>> &g,
                                   const std::vector<double> &c)
{
  std::vector<double> x(c.size(), 0.0);
  for (int round = 0; round < descent_rounds; round++) {
    for (size_t j = 0; j < x.size(); j++) {
      double slope = -c[j];
      for (size_t k = 0; k < x.size(); k++) {
        slope += g[j][k] * x[k];
      }
      x[j] = std::max(0.0, x[j] - slope / g[j][j]);
    }
  }
  return x;
}

}  // namespace spectral_rule_detail

/* A rule of `count` nodes for the sensitivities of colour_table, fitted for paths up to
 * `path_nm`. */
inline SpectralRule spectral_rule(const ColourTable &sensitivities,
                                  const int count,
                                  const double path_nm)
{
  using namespace spectral_rule_detail;
  SpectralRule rule;
  rule.wavelength_nm = quantiles(sensitivities, count);
  /* How much each X counts. */
  std::vector<double> importance;
  for (double x = 0.0; x <= 1.0; x += path_step_nm / path_nm) {
    importance.push_back(x == 0.0 ? flat_importance : std::exp(-x * x));
  }
  /* Sum over X of cos(2 pi X (1 / a - 1 / b)): the product of the functions at two wavelengths. */
  const auto product = [&](const double a, const double b) {
    const double step = std::cos(2.0 * M_PI * path_step_nm * (1.0 / a - 1.0 / b));
    double cosine = 1.0, before = step, sum = 0.0;
    for (const double weight : importance) {
      sum += weight * cosine;
      const double next = 2.0 * step * cosine - before;
      before = cosine;
      cosine = next;
    }
    return sum;
  };
  std::vector<std::vector<double>> g(count, std::vector<double>(count));
  std::array<std::vector<double>, 3> c;
  c.fill(std::vector<double>(count, 0.0));
  for (int j = 0; j < count; j++) {
    for (int k = 0; k < count; k++) {
      g[j][k] = product(rule.wavelength_nm[j], rule.wavelength_nm[k]);
    }
    for (int i = 0; i < visible_count; i++) {
      const double both = product(rule.wavelength_nm[j], visible_first_nm + i);
      for (int channel = 0; channel < 3; channel++) {
        c[channel][j] += both * sensitivities[i][channel];
      }
    }
  }
  for (int channel = 0; channel < 3; channel++) {
    rule.weight[channel] = descend(g, c[channel]);
    double sum = 0.0;
    for (const double w : rule.weight[channel]) {
      sum += w;
    }
    for (double &w : rule.weight[channel]) {
      w /= sum;
    }
  }
  return rule;
}

}  // namespace icwafer

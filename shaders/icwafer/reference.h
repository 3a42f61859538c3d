/* SPDX-License-Identifier: Apache-2.0 */

/* The models by brute force: every wavelength, every order, in double, straight from the
 * formulas. Slow on purpose; what the renderer's evaluation is compared with (host only). */

#pragma once

#include <cmath>

#include "colour_table.h"
#include "cs348b.h"

namespace icwafer::reference {

struct Rgb {
  double r, g, b;
};

/* sum_k Gaussian(x - k; w) over all k that matter. */
inline double order_lobes(const double x, const double w)
{
  const int reach = int(std::ceil(9.0 * w)) + 1;
  const int nearest = int(std::round(x));
  double sum = 0.0;
  for (int k = nearest - reach; k <= nearest + reach; k++) {
    const double t = (x - k) / w;
    sum += std::exp(-0.5 * t * t);
  }
  return sum / (w * std::sqrt(2.0 * M_PI));
}

/* cs348b_eval by a sum over the visible range in steps of 1 / per_nm nanometre. */
inline Rgb cs348b_eval(const Cs348bParams &p,
                       const GratingGeometry &g,
                       const ColourTable &table,
                       const int per_nm = 4)
{
  const double u = g.u, v = g.v;
  const double path = p.optical_thickness_nm *
                      (g.cos_o + (1.0 + g.tangential_dot) / std::fmax(g.cos_i, 1e-3f));
  Rgb sum = {0.0, 0.0, 0.0};
  for (int i = 0; i < (visible_count - 1) * per_nm; i++) {
    const double position = (i + 0.5) / per_nm;
    const double lambda = visible_first_nm + position;
    double f = 1.0 / M_PI;
    if (p.effects & cs348b_wire_diffraction) {
      const double a = M_PI / lambda * p.width_nm * u;
      f *= a == 0.0 ? 1.0 : std::sin(a) / a * (std::sin(a) / a);
    }
    if (p.effects & cs348b_grating) {
      f *= order_lobes(u * p.spacing_nm / lambda, p.lobe_width * p.spacing_nm / lambda);
    }
    if (p.effects & cs348b_thin_film) {
      const double c = std::cos(M_PI / lambda * path);
      f *= c * c;
    }
    const int cell = int(position);
    const double t = position - cell;
    const auto s = [&](int c) { return (1.0 - t) * table[cell][c] + t * table[cell + 1][c]; };
    sum.r += f * s(0);
    sum.g += f * s(1);
    sum.b += f * s(2);
  }
  const double scale = (p.anisotropy > 0.0f ? std::pow(std::fabs(v), p.anisotropy) : 1.0) / per_nm;
  return {scale * sum.r, scale * sum.g, scale * sum.b};
}

}  // namespace icwafer::reference

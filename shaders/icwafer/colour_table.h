/* SPDX-License-Identifier: Apache-2.0 */

/* From a spectrum to the working space's red, green and blue (host side, in double).
 *
 *   f_rgb = integral of S_rgb(lambda) f(lambda) d lambda
 *
 * S_rgb are the working space's sensitivities under a lamp of equal energy: the colour-matching
 * functions of CIE 1931 (cie1931.h) times the matrix from XYZ to the working space, each channel
 * divided by its own integral, so that a flat reflectance is exactly (1, 1, 1) in every space.
 *
 * A single wavelength lies outside every working space: some S_rgb are negative there. Clipping
 * such colours turns a rainbow into stripes of red, green and blue; moving each wavelength
 * towards the neutral of its own luminance until its smallest channel is zero keeps the cyan and
 * the yellow. This is done here, once a wavelength, so that everything after is linear in the
 * spectrum and never negative. The mapping leaves kinks where a channel reaches zero; a Gaussian
 * of 5 nm rounds them, so that few wavelengths suffice to integrate (quadrature.h). */

#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "cie1931.h"
#include "spectrum.h"

namespace icwafer {

/* Rows: red, green, blue. Columns: X, Y, Z. */
using XyzToRgb = std::array<std::array<double, 3>, 3>;

enum class Gamut {
  /* Each wavelength moved into the working space: never negative. */
  Mapped,
  /* Colorimetrically exact; monochromatic light has negative channels. */
  Exact,
};

/* S_rgb per nanometre at each nanometre of the visible range; the sum of each channel is 1. */
using ColourTable = std::array<std::array<double, 3>, visible_count>;

namespace colour_table_detail {

inline void normalise_channels(ColourTable &table)
{
  for (int c = 0; c < 3; c++) {
    double sum = 0.0;
    for (const auto &s : table) {
      sum += s[c];
    }
    for (auto &s : table) {
      s[c] /= sum;
    }
  }
}

inline ColourTable smoothed(const ColourTable &table, const double sigma_nm)
{
  const int reach = int(4.0 * sigma_nm);
  ColourTable result = {};
  for (int i = 0; i < visible_count; i++) {
    for (int j = std::max(0, i - reach); j <= std::min(visible_count - 1, i + reach); j++) {
      const double t = (i - j) / sigma_nm;
      for (int c = 0; c < 3; c++) {
        result[i][c] += std::exp(-0.5 * t * t) * table[j][c];
      }
    }
  }
  return result;
}

/* The weights of red, green and blue in luminance: the Y row of the inverse matrix, scaled to
 * the sum 1 because white is (1, 1, 1) here. */
inline std::array<double, 3> luminance_weights(const XyzToRgb &m)
{
  const auto cofactor = [&m](int i, int j) {
    const int a = (i + 1) % 3, b = (i + 2) % 3, c = (j + 1) % 3, d = (j + 2) % 3;
    return m[a][c] * m[b][d] - m[a][d] * m[b][c];
  };
  std::array<double, 3> w = {cofactor(0, 1), cofactor(1, 1), cofactor(2, 1)};
  const double sum = w[0] + w[1] + w[2];
  for (double &x : w) {
    x /= sum;
  }
  return w;
}

}  // namespace colour_table_detail

inline ColourTable colour_table(const XyzToRgb &xyz_to_rgb, const Gamut gamut = Gamut::Mapped)
{
  ColourTable table;
  for (int i = 0; i < visible_count; i++) {
    const double *xyz = cie1931[visible_first_nm + i - cie1931_first_nm];
    for (int c = 0; c < 3; c++) {
      table[i][c] = xyz_to_rgb[c][0] * xyz[0] + xyz_to_rgb[c][1] * xyz[1] +
                    xyz_to_rgb[c][2] * xyz[2];
    }
  }
  colour_table_detail::normalise_channels(table);
  if (gamut == Gamut::Exact) {
    return table;
  }

  const std::array<double, 3> weight = colour_table_detail::luminance_weights(xyz_to_rgb);
  for (auto &s : table) {
    const double luminance = weight[0] * s[0] + weight[1] * s[1] + weight[2] * s[2];
    const double lowest = std::min({s[0], s[1], s[2]});
    if (lowest < 0.0) {
      /* Luminance is positive in every real space; 0 guards a degenerate matrix. */
      const double chroma = luminance > 0.0 ? luminance / (luminance - lowest) : 0.0;
      for (double &x : s) {
        x = std::max(0.0, luminance + chroma * (x - luminance));
      }
    }
  }
  table = colour_table_detail::smoothed(table, 5.0);
  colour_table_detail::normalise_channels(table);
  return table;
}

}  // namespace icwafer

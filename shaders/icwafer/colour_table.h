/* SPDX-License-Identifier: Apache-2.0 */

/* From a spectrum to the working space's red, green and blue (host side, in double).
 *
 *   f_rgb = integral of S_rgb(lambda) f(lambda) d lambda
 *
 * S_rgb are the working space's sensitivities under a lamp: the colour-matching functions of CIE
 * 1931 (cie1931.h) times the matrix from XYZ to the working space, times the lamp's spectrum
 * (illuminant_table.h), each channel divided by its own integral, so that a flat reflectance is
 * exactly (1, 1, 1) in every space and under every lamp. Colours are relative to the lamp's white,
 * as they are to an eye that has adapted to it: the colour of the light itself is the renderer's.
 *
 * A single wavelength lies outside every working space: some S_rgb are negative there. Clipping
 * such colours turns a rainbow into stripes of red, green and blue; moving each wavelength
 * towards the neutral of its own luminance until its smallest channel is zero keeps the cyan and
 * the yellow. This is done here, once a wavelength, so that everything after is linear in the
 * spectrum and never negative. The mapping leaves kinks where a channel reaches zero; a Gaussian
 * of 5 nm rounds them, so that few wavelengths suffice to integrate (quadrature.h).
 *
 * The mapping of a wavelength does not depend on how much of it the lamp has, so the lamp's
 * spectrum comes after it and its lines stay as narrow as the table of the lamp allows: each of
 * its samples, 5 nm apart, becomes a Gaussian of 3 nm, the narrowest that leaves no ripple of
 * the samples (exp(-(2 pi 3/5)^2 / 2) = 8e-4). */

#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "cie1931.h"
#include "illuminant_table.h"

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

/* Power at each nanometre of the visible range. */
using LampPower = std::array<double, visible_count>;

/* Divides each channel by its integral under a lamp. */
inline void normalise_channels(ColourTable &table, const LampPower &power)
{
  for (int c = 0; c < 3; c++) {
    double sum = 0.0;
    for (int i = 0; i < visible_count; i++) {
      sum += power[i] * table[i][c];
    }
    for (auto &s : table) {
      s[c] /= sum;
    }
  }
}

inline double gaussian_kernel(const double t)
{
  return std::exp(-0.5 * t * t);
}

inline LampPower lamp_power(const Illuminant illuminant)
{
  LampPower power;
  for (int i = 0; i < visible_count; i++) {
    if (illuminant == illuminant_equal_energy) {
      power[i] = 1.0;
      continue;
    }
    double sum = 0.0, weights = 1.0;
    if (illuminant == illuminant_sodium) {
      /* A lamp has both lines about equally strong; the 2 nm are for the quadrature. */
      for (const double line_nm : sodium_lines_nm) {
        sum += gaussian_kernel((visible_first_nm + i - line_nm) / 2.0);
      }
    }
    else {
      weights = 0.0;
      for (int j = 0; j < illuminant_sample_count; j++) {
        const double weight = gaussian_kernel((i - j * illuminant_step_nm) / 3.0);
        sum += weight * illuminant_table[illuminant - illuminant_d65][j];
        weights += weight;
      }
    }
    power[i] = sum / weights;
  }
  return power;
}

inline ColourTable smoothed(const ColourTable &table, const double sigma_nm)
{
  const int reach = int(4.0 * sigma_nm);
  ColourTable result = {};
  for (int i = 0; i < visible_count; i++) {
    for (int j = std::max(0, i - reach); j <= std::min(visible_count - 1, i + reach); j++) {
      const double weight = gaussian_kernel((i - j) / sigma_nm);
      for (int c = 0; c < 3; c++) {
        result[i][c] += weight * table[j][c];
      }
    }
  }
  return result;
}

/* The weights of red, green and blue in the luminance of a picture: the Y row of the inverse
 * matrix, scaled to the sum 1 because white is (1, 1, 1) here, under any lamp. */
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

/* The working space's sensitivities under equal energy, not normalised. */
inline ColourTable matched_table(const XyzToRgb &xyz_to_rgb)
{
  ColourTable table;
  for (int i = 0; i < visible_count; i++) {
    const double *xyz = cie1931[visible_first_nm + i - cie1931_first_nm];
    for (int c = 0; c < 3; c++) {
      table[i][c] = xyz_to_rgb[c][0] * xyz[0] + xyz_to_rgb[c][1] * xyz[1] +
                    xyz_to_rgb[c][2] * xyz[2];
    }
  }
  return table;
}

inline ColourTable neutral_table()
{
  ColourTable table;
  table.fill({1.0, 1.0, 1.0});
  return table;
}

/* Moves each wavelength into the gamut, towards the neutral of the same luminance. */
inline void map_into_gamut(ColourTable &table, const std::array<double, 3> &weight)
{
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
}

}  // namespace colour_table_detail

/* The table of a working space under a lamp. Light of one colour only has no colour to be relative
 * to: under sodium all channels are the same. */
inline ColourTable colour_table(const XyzToRgb &xyz_to_rgb,
                                const Illuminant illuminant,
                                const Gamut gamut = Gamut::Mapped)
{
  using namespace colour_table_detail;
  const LampPower power = lamp_power(illuminant);
  ColourTable table = illuminant == illuminant_sodium ? neutral_table() :
                                                        matched_table(xyz_to_rgb);
  normalise_channels(table, power);
  if (gamut == Gamut::Mapped) {
    map_into_gamut(table, luminance_weights(xyz_to_rgb));
    table = smoothed(table, 5.0);
    normalise_channels(table, power);
  }
  for (int i = 0; i < visible_count; i++) {
    for (double &s : table[i]) {
      s *= power[i];
    }
  }
  return table;
}

inline ColourTable colour_table(const XyzToRgb &xyz_to_rgb, const Gamut gamut = Gamut::Mapped)
{
  return colour_table(xyz_to_rgb, illuminant_equal_energy, gamut);
}

}  // namespace icwafer

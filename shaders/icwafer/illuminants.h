/* SPDX-License-Identifier: Apache-2.0 */

/* Lamps by name. Their spectra are in illuminant_table.h and enter the sensitivities once, in
 * colour_table.h; an evaluation needs to know no more than how fast these vary. */

#pragma once

#include "spectrum.h"

namespace icwafer {

enum Illuminant {
  illuminant_equal_energy,
  illuminant_d65,
  illuminant_a,
  illuminant_f2,
  illuminant_f11,
  illuminant_white_led,
  illuminant_sodium,
  illuminant_count,
};

/* D65 to white LED have tables, one value every 5 nm. */
constexpr int illuminant_tabulated_count = illuminant_white_led;
constexpr int illuminant_step_nm = 5;
constexpr int illuminant_sample_count = (visible_last_nm - visible_first_nm) / illuminant_step_nm +
                                        1;

/* The lines D2 and D1 of neutral sodium in air (NIST Atomic Spectra Database): the light of a
 * low-pressure sodium lamp. */
constexpr double sodium_lines_nm[2] = {588.995, 589.592};
constexpr float sodium_mean_nm = 589.29f;

/* Bandwidth of the sensitivities under a lamp (colour_table.h, gamut mapped), in radian per
 * nanometre: faster oscillations with wavelength have less than 0.1 % of the amplitude of the
 * mean, in every channel. A trapezoid rule with a step below 2 pi / bandwidth integrates them. */
ICW_DEVICE float illuminant_bandwidth_per_nm(const Illuminant illuminant)
{
  constexpr float per_nm[illuminant_count] = {0.51f, 0.51f, 0.43f, 1.08f, 1.42f, 0.51f, 2.28f};
  return per_nm[illuminant];
}

/* How the eye under a lamp blurs an oscillation over 1 / lambda: one of `path` nanometres, longer
 * than 4 um, has at most exp(-blur * path) of the amplitude of the mean in any channel, or less
 * than 0.1 %. */
ICW_DEVICE float illuminant_blur_per_nm(const Illuminant illuminant)
{
  constexpr float per_nm[illuminant_count] = {
      3.2e-4f, 2.9e-4f, 3.2e-4f, 1.3e-4f, 8e-5f, 3.2e-4f, 2.5e-6f};
  return per_nm[illuminant];
}

}  // namespace icwafer

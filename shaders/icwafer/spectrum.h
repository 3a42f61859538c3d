/* SPDX-License-Identifier: Apache-2.0 */

/* The visible range and the look-up of the working space's sensitivities in it.
 *
 * The evaluations take any `Sensitivity`: a function object from a wavelength in nanometres,
 * inside [visible_first_nm, visible_last_nm], to the Rgb that one nanometre of a flat spectrum
 * there contributes. In the host it reads a ColourTable (colour_table.h), in the Cycles kernel
 * the same table on the device. */

#pragma once

#include "platform.h"

namespace icwafer {

constexpr int visible_first_nm = 380;
constexpr int visible_last_nm = 780;
constexpr int visible_count = visible_last_nm - visible_first_nm + 1;

/* Linear interpolation in a table with one Rgb for each nanometre; `read(i)` gives number i. */
template<typename Read>
ICW_DEVICE Rgb sensitivity_at(const float wavelength_nm, const Read &read)
{
  const float position = clamped(
      wavelength_nm - visible_first_nm, 0.0f, float(visible_count - 1) - 1e-3f);
  const int index = int(position);
  const float fraction = position - float(index);
  return (1.0f - fraction) * read(index) + fraction * read(index + 1);
}

}  // namespace icwafer

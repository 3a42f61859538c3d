/* SPDX-License-Identifier: Apache-2.0 */

/* Metals by name: the look-up of their complex index n + i k (absorbing: k > 0). The values and
 * the papers that they are from are in metal_table.h; a kernel reads a copy of that table. */

#pragma once

#include "spectrum.h"

namespace icwafer {

enum Metal {
  metal_copper,
  metal_aluminium,
  metal_tungsten,
  metal_silicon,
  /* Index given by the artist; not in the table. */
  metal_custom,
};

/* Metals in the table, wavelengths of each, and floats in all: {n, k} for each wavelength of each
 * metal. */
constexpr int metal_tabulated_count = metal_custom;
constexpr int metal_step_nm = 5;
constexpr int metal_wavelength_count = (visible_last_nm - visible_first_nm) / metal_step_nm + 1;
constexpr int metal_table_size = metal_tabulated_count * metal_wavelength_count * 2;

struct ComplexIndex {
  float n, k;
};

/* Index of a metal of the table by linear interpolation; wavelengths outside the visible range
 * take the value at its end. `read(i)` gives float number i of the table. */
template<typename Read>
ICW_DEVICE ComplexIndex metal_index_at(const Metal metal,
                                       const float wavelength_nm,
                                       const Read &read)
{
  const float position = clamped((wavelength_nm - visible_first_nm) * (1.0f / metal_step_nm),
                                 0.0f,
                                 float(metal_wavelength_count - 1) - 1e-4f);
  const int cell = int(position);
  const float t = position - float(cell);
  const int i = 2 * (int(metal) * metal_wavelength_count + cell);
  return {(1.0f - t) * read(i) + t * read(i + 2), (1.0f - t) * read(i + 1) + t * read(i + 3)};
}

}  // namespace icwafer

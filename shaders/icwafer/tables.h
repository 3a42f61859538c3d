/* SPDX-License-Identifier: Apache-2.0 */

/* The tables that an evaluation reads, flat, as a renderer keeps them: for each lamp the working
 * space's sensitivities {red, green, blue} at each nanometre of the visible range, then for each
 * metal the index {n, k} at each nanometre. `material_tables` (material_tables.h) makes them. */

#pragma once

#include "illuminants.h"
#include "metals.h"

namespace icwafer {

constexpr int sensitivity_table_size = 3 * visible_count;
constexpr int metal_tables_offset = illuminant_count * sensitivity_table_size;
constexpr int material_tables_size = metal_tables_offset +
                                     2 * visible_count * metal_tabulated_count;

/* `Read` is a function object from the number of a float to its value. */
template<typename Read>
struct MaterialTables {
  Read read;

  /* Number `cell` of the visible range. */
  ICW_DEVICE_METHOD Rgb sensitivity(const Illuminant illuminant, const int cell) const
  {
    const int i = int(illuminant) * sensitivity_table_size + 3 * cell;
    return {read(i), read(i + 1), read(i + 2)};
  }

  ICW_DEVICE_METHOD ComplexIndex metal(const Metal metal, const int cell) const
  {
    const int i = metal_tables_offset + 2 * (int(metal) * visible_count + cell);
    return {read(i), read(i + 1)};
  }

  /* Sensitivity at a wavelength, under light of equal energy. */
  ICW_DEVICE_METHOD Rgb operator()(const float wavelength_nm) const
  {
    return sensitivity_at(wavelength_nm, [this](const int cell) {
      return sensitivity(illuminant_equal_energy, cell);
    });
  }
};

}  // namespace icwafer

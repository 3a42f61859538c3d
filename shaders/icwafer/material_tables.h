/* SPDX-License-Identifier: Apache-2.0 */

/* Makes the tables of tables.h for a working space (host only). */

#pragma once

#include <vector>

#include "colour_table.h"
#include "metal_table.h"
#include "tables.h"

namespace icwafer {

inline std::vector<float> material_tables(const XyzToRgb &xyz_to_rgb)
{
  std::vector<float> tables;
  tables.reserve(material_tables_size);
  for (int illuminant = 0; illuminant < illuminant_count; illuminant++) {
    for (const auto &rgb : colour_table(xyz_to_rgb, Illuminant(illuminant))) {
      for (const double channel : rgb) {
        tables.push_back(float(channel));
      }
    }
  }
  for (int metal = 0; metal < metal_tabulated_count; metal++) {
    for (int nm = visible_first_nm; nm <= visible_last_nm; nm++) {
      const ComplexIndex index = metal_index_at(
          Metal(metal), float(nm), [](const int i) { return metal_table[i]; });
      tables.push_back(index.n);
      tables.push_back(index.k);
    }
  }
  return tables;
}

}  // namespace icwafer

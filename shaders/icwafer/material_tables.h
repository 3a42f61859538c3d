/* SPDX-License-Identifier: Apache-2.0 */

/* Makes the tables of tables.h for a working space (host only). */

#pragma once

#include <vector>

#include "colour_table.h"
#include "metal_table.h"
#include "spectral_rules.h"
#include "tables.h"

namespace icwafer {

namespace material_tables_detail {

inline ComplexIndex index_of(const int metal, const double wavelength_nm)
{
  return metal_index_at(
      Metal(metal), float(wavelength_nm), [](const int i) { return metal_table[i]; });
}

inline void append_rules(std::vector<float> &tables, const ColourTable &sensitivities)
{
  for (int r = 0; r < rule_count; r++) {
    const SpectralRule rule = spectral_rule(
        sensitivities, rule_nodes(r), double(rule_fitted_paths * rule_path_nm(r)));
    tables.insert(tables.end(), rule.wavelength_nm.begin(), rule.wavelength_nm.end());
    for (const std::vector<double> &weight : rule.weight) {
      tables.insert(tables.end(), weight.begin(), weight.end());
    }
    for (int metal = 0; metal < metal_tabulated_count; metal++) {
      for (const double nm : rule.wavelength_nm) {
        tables.push_back(index_of(metal, nm).n);
      }
      for (const double nm : rule.wavelength_nm) {
        tables.push_back(index_of(metal, nm).k);
      }
    }
  }
}

}  // namespace material_tables_detail

inline std::vector<float> material_tables(const XyzToRgb &xyz_to_rgb)
{
  using namespace material_tables_detail;
  std::vector<ColourTable> sensitivities;
  for (int illuminant = 0; illuminant < illuminant_count; illuminant++) {
    sensitivities.push_back(colour_table(xyz_to_rgb, Illuminant(illuminant)));
  }
  std::vector<float> tables;
  tables.reserve(material_tables_size);
  for (const ColourTable &table : sensitivities) {
    for (const auto &rgb : table) {
      tables.insert(tables.end(), rgb.begin(), rgb.end());
    }
  }
  for (int metal = 0; metal < metal_tabulated_count; metal++) {
    for (int nm = visible_first_nm; nm <= visible_last_nm; nm++) {
      const ComplexIndex index = index_of(metal, nm);
      tables.push_back(index.n);
      tables.push_back(index.k);
    }
  }
  for (const ColourTable &table : sensitivities) {
    append_rules(tables, table);
  }
  return tables;
}

}  // namespace icwafer

/* SPDX-License-Identifier: Apache-2.0 */

/* Makes the tables of tables.h for a working space (host only). */

#pragma once

#include <algorithm>
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

/* Noise of a colour is least where it is sampled in proportion to the root of the mean square of
 * what it adds; here to the luminance, and less to the channels. */
constexpr double luminance_part = 0.65;

inline double sampling_weight(const std::array<double, 3> &rgb,
                              const std::array<double, 3> &luminance_weight)
{
  double luminance = 0.0, channels = 0.0;
  for (int c = 0; c < 3; c++) {
    luminance += luminance_weight[c] * rgb[c];
    channels += rgb[c] * rgb[c] / 3.0;
  }
  return std::sqrt(luminance_part * luminance * luminance + (1.0 - luminance_part) * channels);
}

/* Part of the edges that is spread evenly over the spectrum. */
constexpr double even_edges_part = 0.5;
/* Part of the weight beyond the outermost edges, on either side. */
constexpr double beyond_edges = 0.002;

inline void append_bands(std::vector<float> &tables,
                         const ColourTable &sensitivities,
                         const std::array<double, 3> &luminance_weight)
{
  /* Weight, and density of edges, up to the end of each nanometre. */
  std::vector<double> weight, edges;
  double sum = 0.0;
  for (const std::array<double, 3> &rgb : sensitivities) {
    sum += sampling_weight(rgb, luminance_weight);
    weight.push_back(sum);
  }
  for (size_t i = 0; i < weight.size(); i++) {
    edges.push_back((1.0 - even_edges_part) * weight[i] / sum +
                    even_edges_part * double(i + 1) / double(weight.size()));
  }
  const auto first_above = [](const std::vector<double> &x, const double value) {
    return int(std::lower_bound(x.begin(), x.end(), value) - x.begin());
  };
  const int first = first_above(weight, beyond_edges * sum);
  const int last = first_above(weight, (1.0 - beyond_edges) * sum);
  std::vector<int> edge;
  for (int k = 0; k < band_edge_count; k++) {
    const double part = double(k) / (band_edge_count - 1);
    const int cell = first_above(edges, (1.0 - part) * edges[first] + part * edges[last]);
    edge.push_back(k > 0 ? std::max(cell, edge.back() + 1) : cell);
  }
  const auto edge_nm = [&](const int k) { return double(visible_first_nm + edge[k]) + 0.5; };
  /* What the nodes share in a band: one of them, or its neighbours. */
  const auto share = [](const int node, const int band) {
    return 0.5 * ((band / 2 == node) + ((band + 1) / 2 == node));
  };
  for (int k = 0; k < band_edge_count; k++) {
    tables.push_back(float(edge_nm(k)));
  }
  double part[band_node_count] = {};
  for (int node = 0; node < band_node_count; node++) {
    double rise[band_edge_count] = {};
    for (int band = 0; band < band_count; band++) {
      const double power = share(node, band) * (weight[edge[band + 1]] - weight[edge[band]]);
      const double density = power / (edge_nm(band + 1) - edge_nm(band));
      rise[band] += density;
      rise[band + 1] -= density;
      part[node] += power / (weight[edge[band_count]] - weight[edge[0]]);
    }
    tables.insert(tables.end(), rise, rise + band_edge_count);
  }
  const auto append_nodes = [&](const auto &value) {
    for (int k = 0; k < 2 * band_node_count; k++) {
      const int node = k % band_node_count;
      tables.push_back(float(value(node, 0.5 * (edge_nm(2 * node) + edge_nm(2 * node + 1)))));
    }
  };
  append_nodes([](int, const double nm) { return nm; });
  append_nodes([&](const int node, double) { return 0.5 * part[node]; });
  for (int metal = 0; metal < metal_tabulated_count; metal++) {
    append_nodes([&](int, const double nm) { return index_of(metal, nm).n; });
    append_nodes([&](int, const double nm) { return index_of(metal, nm).k; });
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
  for (const ColourTable &table : sensitivities) {
    append_bands(tables, table, colour_table_detail::luminance_weights(xyz_to_rgb));
  }
  return tables;
}

}  // namespace icwafer

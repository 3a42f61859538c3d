/* SPDX-License-Identifier: Apache-2.0 */

/* The tables that an evaluation reads, flat, as a renderer keeps them:
 *
 * - for each lamp the working space's sensitivities {red, green, blue} at each nanometre of the
 *   visible range,
 * - for each metal the index {n, k} at each nanometre,
 * - for each lamp the quadrature rules (spectral_rules.h), each in rows as long as it has nodes:
 *   wavelength; weights of red, green, blue; n and k of each metal,
 * - for each lamp the bands of the spectrum for sampling (BandRow).
 *
 * `material_tables` (material_tables.h) makes them. */

#pragma once

#include "complex.h"
#include "illuminants.h"
#include "metals.h"

namespace icwafer {

constexpr int sensitivity_table_size = 3 * visible_count;
constexpr int metal_tables_offset = illuminant_count * sensitivity_table_size;
constexpr int rule_tables_offset = metal_tables_offset + 2 * visible_count * metal_tabulated_count;

/* Rules integrate a spectrum with the sensitivities under a lamp from few wavelengths, whole
 * vectors of them, within 0.5 % as long as the spectrum is a film's whose light goes no further
 * than this, there and back. */
/* How many times as far a spectrum may have more than a film's: rules are fitted so far, because a
 * film's has harmonics. */
constexpr float rule_fitted_paths = 2.4f;
constexpr int rule_count = 5;
constexpr int rule_rows = 4 + 2 * metal_tabulated_count;

ICW_DEVICE constexpr int rule_nodes(const int rule)
{
  return 8 * (rule + 1);
}

ICW_DEVICE constexpr float rule_path_nm(const int rule)
{
  constexpr float path_nm[rule_count] = {900.0f, 2500.0f, 4500.0f, 6500.0f, 8500.0f};
  return path_nm[rule];
}

/* Nodes of the rules before this one. */
ICW_DEVICE constexpr int rule_first_node(const int rule)
{
  return 4 * rule * (rule + 1);
}

constexpr int rules_size = rule_rows * rule_first_node(rule_count);
constexpr int band_tables_offset = rule_tables_offset + illuminant_count * rules_size;

/* Bands in which sampling takes the spectrum of a lamp as even: narrow where the eye sees much.
 * What a surface reflects is looked up in the middle of every other band only. */
constexpr int band_count = 7, band_edge_count = band_count + 1, band_node_count = 4;
static_assert(band_edge_count == 2 * band_node_count, "rows have one length");

/* Rows of band_edge_count: the edges; for each node how much the density of sampling rises at each
 * edge where only it reflects; then, for the nodes on either side of the mirror direction, the
 * wavelength, its part in the spectrum, and n and k of each metal. */
enum BandRow {
  band_row_edge_nm,
  band_row_rise,
  band_row_node_nm = band_row_rise + band_node_count,
  band_row_part,
  band_row_metal,
};
constexpr int bands_size = band_edge_count * (band_row_metal + 2 * metal_tabulated_count);

constexpr int material_tables_size = band_tables_offset + illuminant_count * bands_size;

ICW_DEVICE constexpr int sensitivity_index(const Illuminant illuminant, const int cell)
{
  return int(illuminant) * sensitivity_table_size + 3 * cell;
}

ICW_DEVICE constexpr int metal_index(const Metal metal, const int cell)
{
  return metal_tables_offset + 2 * (int(metal) * visible_count + cell);
}

/* `Read` is a function object from the number of a float to its place. */
template<typename Read>
struct MaterialTables {
  Read read;

  /* Number `cell` of the visible range. */
  ICW_DEVICE_METHOD Rgb sensitivity(const Illuminant illuminant, const int cell) const
  {
    const int i = sensitivity_index(illuminant, cell);
    return {*read(i), *read(i + 1), *read(i + 2)};
  }

  /* Of a cell for each lane. */
  ICW_DEVICE_METHOD void sensitivities(const Illuminant illuminant,
                                       const int *cells,
                                       Lanes &red,
                                       Lanes &green,
                                       Lanes &blue) const
  {
    const float *at[lane_count];
    for (int lane = 0; lane < lane_count; lane++) {
      at[lane] = read(sensitivity_index(illuminant, cells[lane]));
    }
    Lanes next_red;
    load_records(at, red, green, blue, next_red);
  }

  ICW_DEVICE_METHOD ComplexIndex metal(const Metal metal, const int cell) const
  {
    const float *const index = read(metal_index(metal, cell));
    return {index[0], index[1]};
  }

  /* Of a cell for each lane, and of the next. */
  ICW_DEVICE_METHOD void metals(const Metal metal,
                                const int *cells,
                                Complex<Lanes> &index,
                                Complex<Lanes> &next) const
  {
    const float *at[lane_count];
    for (int lane = 0; lane < lane_count; lane++) {
      at[lane] = read(metal_index(metal, cells[lane]));
    }
    load_records(at, index.re, index.im, next.re, next.im);
  }

  /* Part of a row of a rule, from `node`. */
  ICW_DEVICE_METHOD Lanes rule_row(const Illuminant illuminant,
                                   const int rule,
                                   const int row,
                                   const int node) const
  {
    return load_lanes(read(rule_tables_offset + int(illuminant) * rules_size +
                           rule_rows * rule_first_node(rule) + row * rule_nodes(rule) + node));
  }

  /* Part of a row of the bands, from `column`. */
  ICW_DEVICE_METHOD Lanes band_row(const Illuminant illuminant,
                                   const int row,
                                   const int column) const
  {
    return load_lanes(
        read(band_tables_offset + int(illuminant) * bands_size + band_edge_count * row + column));
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

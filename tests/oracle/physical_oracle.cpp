/* SPDX-License-Identifier: GPL-2.0-or-later */

/* The PHYSICAL model as the headers evaluate it, in float as a renderer does.
 *
 * Standard input, 32-bit floats: the 9 numbers of the matrix from XYZ to the working space, row by
 * row; 20 parameters in the order read below; then for each evaluation the unit vectors to the
 * light and to the eye, (across the wires, along them, normal). Standard output: red, green and
 * blue for each. */

#include <cstdio>
#include <vector>

#include "icwafer/material_tables.h"
#include "icwafer/physical.h"

using namespace icwafer;

int main()
{
  std::vector<float> in;
  float block[4096];
  for (size_t count; (count = std::fread(block, sizeof(float), std::size(block), stdin)) > 0;) {
    in.insert(in.end(), block, block + count);
  }
  constexpr size_t matrix_size = 9, param_count = 20, directions_size = 6;
  if (in.size() < matrix_size + param_count) {
    std::fprintf(stderr, "physical_oracle: %zu numbers are no matrix and parameters\n", in.size());
    return 2;
  }

  XyzToRgb matrix;
  for (size_t i = 0; i < matrix_size; i++) {
    matrix[i / 3][i % 3] = in[i];
  }
  const std::vector<float> tables = material_tables(matrix);
  const auto read = [&tables](const int i) { return &tables[size_t(i)]; };

  const float *p = in.data() + matrix_size;
  const float spacing_nm = p[0], width_nm = p[1], cross_spacing_nm = p[2], cross_width_nm = p[3];
  const float oxide_nm = p[4], groove_nm = p[5], coherence_um = p[6], roughness = p[7];
  const float variation = p[8], custom_ior = p[10], length_um = p[19];
  PhysicalParams params = physical_params(
      physical_lattice(spacing_nm, width_nm, coherence_um),
      physical_lattice(cross_spacing_nm, cross_width_nm, length_um),
      oxide_nm,
      groove_nm,
      roughness,
      variation,
      Oxide(int(p[9])),
      custom_ior,
      Metal(int(p[11])),
      Illuminant(int(p[12])));
  physical_set_custom_metal(params, p[13], p[14], p[15], p[16], p[17], p[18]);

  const MaterialTables<decltype(read)> material = {read};
  for (size_t i = matrix_size + param_count; i + directions_size <= in.size();
       i += directions_size) {
    const float *w = &in[i];
    const Rgb f = physical_eval(params, {w[0], w[1], w[2]}, {w[3], w[4], w[5]}, material);
    const float rgb[3] = {f.r, f.g, f.b};
    std::fwrite(rgb, sizeof(float), 3, stdout);
  }
  return 0;
}

/* SPDX-License-Identifier: GPL-2.0-or-later */

/* Parameters of the PHYSICAL model from the fuzzer's bytes, and the tables that it reads. */

#pragma once

#include "fuzz_input.h"

#include "icwafer/material_tables.h"
#include "icwafer/physical_sample.h"

namespace icwafer::fuzz {

inline const std::vector<float> floats = material_tables(test::working_spaces[0].xyz_to_rgb);

struct Read {
  const float *operator()(const int i) const
  {
    return &floats.at(size_t(i));
  }
};

inline const MaterialTables<Read> tables = {{}};

inline PhysicalParams physical_input(Input &input)
{
  const float spacing_nm = input.socket(50.0f, 200000.0f);
  const float width_nm = input.socket(0.0f, 100000.0f);
  const float cross_spacing_nm = input.flag() ? input.socket(50.0f, 200000.0f) : 0.0f;
  const float cross_width_nm = input.socket(0.0f, 100000.0f);
  const float oxide_nm = input.socket(0.0f, 5000.0f);
  const float groove_nm = input.socket(0.0f, 2000.0f);
  const float coherence_width_um = input.socket(1.0f, 200.0f);
  const float wire_length_um = input.socket(1.0f, 200.0f);
  const float roughness = input.socket(0.0f, 0.6f);
  const float variation = input.flag() ? input.socket(0.0f, 0.3f) : 0.0f;
  const Oxide oxide = Oxide(input.choice(oxide_custom + 1));
  const float ior = input.socket(1.0f, 3.0f);
  PhysicalParams p = physical_params(
      physical_lattice(spacing_nm, width_nm, coherence_width_um),
      physical_lattice(cross_spacing_nm, cross_width_nm, wire_length_um),
      oxide_nm,
      groove_nm,
      roughness,
      variation,
      oxide,
      ior,
      Metal(input.choice(metal_custom + 1)),
      Illuminant(input.choice(illuminant_count)));
  if (p.metal == metal_custom) {
    float index[6];
    for (float &component : index) {
      component = input.socket(0.0f, 10.0f);
    }
    physical_set_custom_metal(p, index[0], index[1], index[2], index[3], index[4], index[5]);
  }
  return p;
}

}  // namespace icwafer::fuzz

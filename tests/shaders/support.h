/* SPDX-License-Identifier: GPL-2.0-or-later */

/* What the tests of the material share: working spaces, a sensitivity that reads a colour table,
 * directions and parameters drawn from a seeded generator. */

#pragma once

#include <array>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "icwafer/colour_table.h"
#include "icwafer/cs348b_sample.h"
#include "icwafer/material_tables.h"

namespace icwafer::test {

struct WorkingSpace {
  std::string name;
  XyzToRgb xyz_to_rgb;
};

/* Matrices from XYZ (relative to the white of the space) of ITU-R BT.709 and BT.2020, and of
 * ACEScg (S-2014-004, white D60). */
inline const std::vector<WorkingSpace> working_spaces = {
    {"Rec709",
     {{{3.2404542, -1.5371385, -0.4985314},
       {-0.9692660, 1.8760108, 0.0415560},
       {0.0556434, -0.2040259, 1.0572252}}}},
    {"Rec2020",
     {{{1.7166512, -0.3556708, -0.2533663},
       {-0.6666844, 1.6164812, 0.0157685},
       {0.0176399, -0.0427706, 0.9421031}}}},
    {"ACEScg",
     {{{1.6410234, -0.3248033, -0.2364247},
       {-0.6636629, 1.6153316, 0.0167563},
       {0.0117219, -0.0082844, 0.9883949}}}},
};

/* Reads a colour table as the renderer does: in float. */
class TableSensitivity {
 public:
  explicit TableSensitivity(const ColourTable &table)
  {
    for (int i = 0; i < visible_count; i++) {
      rgb_[i] = {float(table[i][0]), float(table[i][1]), float(table[i][2])};
    }
  }

  Rgb operator()(const float wavelength_nm) const
  {
    return sensitivity_at(wavelength_nm, [this](const int i) { return rgb_[i]; });
  }

 private:
  std::array<Rgb, visible_count> rgb_;
};

using Random = std::mt19937;

inline float uniform(Random &random, const float low = 0.0f, const float high = 1.0f)
{
  /* 24 bits, as a renderer's random numbers have; never 1. */
  return low + (high - low) * (float(random() >> 8) * 0x1p-24f);
}

inline float log_uniform(Random &random, const float low, const float high)
{
  return std::exp(uniform(random, std::log(low), std::log(high)));
}

/* A unit vector above the surface from its tangential components. */
inline LocalDirection direction(const float nu, const float tau)
{
  return {nu, tau, std::sqrt(std::fmax(1.0f - nu * nu - tau * tau, 0.0f))};
}

/* Even over the unit disc of tangential components. */
inline LocalDirection random_direction(Random &random)
{
  const float r = std::sqrt(uniform(random));
  const float phi = uniform(random, 0.0f, two_pi);
  return direction(r * std::cos(phi), r * std::sin(phi));
}

inline Cs348bParams random_params(Random &random)
{
  const float spacing_nm = log_uniform(random, 300.0f, 20000.0f);
  /* Combinations of effects, all of them more often. */
  const int effects = uniform(random) < 0.5f ? int(cs348b_all_effects) : int(random() % 8);
  return cs348b_params(spacing_nm,
                       spacing_nm * uniform(random, 0.02f, 0.8f),
                       uniform(random, 0.0f, 2000.0f),
                       uniform(random, 1.3f, 2.2f),
                       log_uniform(random, 0.001f, 0.1f),
                       uniform(random) < 0.5f ? 0.0f : uniform(random, 0.0f, 4.0f),
                       effects);
}

}  // namespace icwafer::test

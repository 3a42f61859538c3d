/* SPDX-License-Identifier: GPL-2.0-or-later */

/* The PHYSICAL model for any value at its sockets and any two directions: no NaN, nothing
 * negative, reciprocal, and never more light out than in. */

#include <algorithm>

#include "fuzz_input.h"

#include "icwafer/material_tables.h"
#include "icwafer/physical_sample.h"

using namespace icwafer;

namespace {

const std::vector<float> floats = material_tables(test::working_spaces[0].xyz_to_rgb);

struct Read {
  float operator()(const int i) const
  {
    return floats.at(size_t(i));
  }
};

const MaterialTables<Read> tables = {{}};

PhysicalParams read_params(fuzz::Input &input)
{
  const float spacing_nm = input.socket(50.0f, 200000.0f);
  const float width_nm = input.socket(0.0f, 100000.0f);
  const float cross_spacing_nm = input.flag() ? input.socket(50.0f, 200000.0f) : 0.0f;
  const float cross_width_nm = input.socket(0.0f, 100000.0f);
  const float oxide_nm = input.socket(0.0f, 5000.0f);
  const float groove_nm = input.socket(0.0f, 2000.0f);
  const float coherence_width_um = input.socket(1.0f, 200.0f);
  const float roughness = input.socket(0.0f, 0.6f);
  const float variation = input.flag() ? input.socket(0.0f, 0.3f) : 0.0f;
  const Oxide oxide = Oxide(input.choice(oxide_custom + 1));
  const float ior = input.socket(1.0f, 3.0f);
  PhysicalParams p = physical_params(physical_lattice(spacing_nm, width_nm),
                                     physical_lattice(cross_spacing_nm, cross_width_nm),
                                     oxide_nm,
                                     groove_nm,
                                     coherence_width_um,
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

bool nearly_equal(const float a, const float b)
{
  return std::fabs(a - b) <= 1e-5f * std::fmax(a, b) + 1e-9f;
}

float brightest(const Rgb f)
{
  return std::max({f.r, f.g, f.b});
}

/* The reflectance from sampled directions, one in each cell of a grid of the two random numbers. */
void expect_no_gain(const PhysicalParams &p,
                    const PhysicalView &view,
                    const LocalDirection o,
                    fuzz::Input &input)
{
  constexpr int cells = 48;
  const float shift_across = input.random(), shift_along = input.random();
  double sum[3] = {0.0, 0.0, 0.0}, squares[3] = {0.0, 0.0, 0.0};
  for (int a = 0; a < cells; a++) {
    for (int b = 0; b < cells; b++) {
      const LocalDirection i = physical_sample(p,
                                               view,
                                               o,
                                               (float(a) + shift_across) / float(cells),
                                               (float(b) + shift_along) / float(cells));
      if (i.n > 0.0f) {
        const Rgb f = (i.n / physical_pdf(p, view, o, i)) * physical_eval(p, i, o, tables);
        const double weight[3] = {f.r, f.g, f.b};
        for (int c = 0; c < 3; c++) {
          sum[c] += weight[c];
          squares[c] += weight[c] * weight[c];
        }
      }
    }
  }
  constexpr double count = cells * cells;
  for (int c = 0; c < 3; c++) {
    const double mean = sum[c] / count;
    /* That of independent samples; stratified ones are better. */
    const double error = std::sqrt(std::max(squares[c] / count - mean * mean, 0.0) / count);
    FUZZ_EXPECT(mean < 1.001 + 4.0 * error);
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t *bytes, const size_t count)
{
  fuzz::Input input(bytes, count);
  const PhysicalParams p = read_params(input);
  const LocalDirection o = input.direction();
  const PhysicalView view = physical_view(p, o, tables);
  FUZZ_EXPECT(std::isfinite(view.total_power) && view.total_power > 0.0f);

  const LocalDirection drawn = physical_sample(p, view, o, input.random(), input.random());
  FUZZ_EXPECT(drawn.n == 0.0f || fuzz::is_unit(drawn));
  for (const LocalDirection i : {drawn, input.partner(o, p.across.spacing_nm)}) {
    if (!(i.n > 0.0f && o.n > 0.0f)) {
      continue;
    }
    const float pdf = physical_pdf(p, view, o, i);
    const Rgb f = physical_eval(p, i, o, tables);
    FUZZ_EXPECT(fuzz::is_density(pdf));
    FUZZ_EXPECT(fuzz::is_light(f));
    /* Where there is light, more than underflows, there are samples. */
    FUZZ_EXPECT(pdf > 0.0f || brightest(f) < 1e-20f);
    const Rgb back = physical_eval(p, o, i, tables);
    FUZZ_EXPECT(nearly_equal(f.r, back.r) && nearly_equal(f.g, back.g) &&
                nearly_equal(f.b, back.b));
  }
  if (o.n > 0.0f && input.choice(256) == 255) {
    expect_no_gain(p, view, o, input);
  }
  return 0;
}

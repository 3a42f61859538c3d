/* SPDX-License-Identifier: GPL-2.0-or-later */

/* The CS348B model for any value at its sockets and any two directions. */

#include "fuzz_input.h"

using namespace icwafer;

extern "C" int LLVMFuzzerTestOneInput(const uint8_t *bytes, const size_t count)
{
  static const test::TableSensitivity sensitivity(
      colour_table(test::working_spaces[0].xyz_to_rgb));

  fuzz::Input input(bytes, count);
  const float spacing_nm = input.socket(50.0f, 200000.0f);
  const float width_nm = input.socket(0.0f, 100000.0f);
  const float oxide_nm = input.socket(0.0f, 5000.0f);
  const float ior = input.socket(1.0f, 3.0f);
  const float lobe_width = input.socket(0.0005f, 0.2f);
  const float anisotropy = input.socket(0.0f, 8.0f);
  const Cs348bParams p = cs348b_params(
      spacing_nm, width_nm, oxide_nm, ior, lobe_width, anisotropy, input.choice(8));

  const LocalDirection o = input.direction();
  const float total = cs348b_total_power(p, o.nu);
  FUZZ_EXPECT(std::isfinite(total) && total > 0.0f);

  const LocalDirection drawn = cs348b_sample(p, total, o, input.random(), input.random());
  FUZZ_EXPECT(fuzz::is_unit(drawn));
  for (const LocalDirection i : {drawn, input.partner(o, p.spacing_nm)}) {
    const float pdf = cs348b_pdf(p, total, o, i);
    const Rgb f = cs348b_eval(p, grating_geometry(i, o), sensitivity);
    FUZZ_EXPECT(fuzz::is_density(pdf));
    FUZZ_EXPECT(fuzz::is_light(f));
    /* Where there is light, more than underflows, there are samples; but none at the horizon. */
    FUZZ_EXPECT(pdf > 0.0f || i.n < 1e-6f || f.g < 1e-30f);
  }
  return 0;
}

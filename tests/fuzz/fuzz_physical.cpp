/* SPDX-License-Identifier: GPL-2.0-or-later */

/* The PHYSICAL model for any value at its sockets and any two directions: no NaN, nothing
 * negative, and the same in both directions. */

#include <algorithm>

#include "fuzz_physical_input.h"

using namespace icwafer;

namespace {

bool nearly_equal(const float a, const float b)
{
  return std::fabs(a - b) <= 1e-5f * std::fmax(a, b) + 1e-9f;
}

float brightest(const Rgb f)
{
  return std::max({f.r, f.g, f.b});
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t *bytes, const size_t count)
{
  fuzz::Input input(bytes, count);
  const PhysicalParams p = fuzz::physical_input(input);
  const LocalDirection o = input.direction();
  const PhysicalView view = physical_view(p, o, fuzz::tables);
  FUZZ_EXPECT(std::isfinite(view.total_power) && view.total_power > 0.0f);
  /* A bump map can turn the normal away from the eye. */
  const PhysicalView below = physical_view(p, {o.nu, o.tau, -o.n}, fuzz::tables);
  FUZZ_EXPECT(std::isfinite(below.total_power) && below.total_power > 0.0f);

  const LocalDirection drawn = physical_sample(p, view, o, input.random(), input.random());
  FUZZ_EXPECT(drawn.n == 0.0f || fuzz::is_unit(drawn));
  for (const LocalDirection i : {drawn, input.partner(o, p.across.spacing_nm)}) {
    if (!(i.n > 0.0f && o.n > 0.0f)) {
      continue;
    }
    const float pdf = physical_pdf(p, view, o, i);
    const Rgb f = physical_eval(p, i, o, fuzz::tables);
    FUZZ_EXPECT(fuzz::is_density(pdf));
    FUZZ_EXPECT(fuzz::is_light(f));
    /* Where there is light there are samples. */
    FUZZ_EXPECT(pdf > 0.0f || brightest(f) < 1e-20f);
    const Rgb back = physical_eval(p, o, i, fuzz::tables);
    FUZZ_EXPECT(nearly_equal(f.r, back.r) && nearly_equal(f.g, back.g) &&
                nearly_equal(f.b, back.b));
  }
  return 0;
}

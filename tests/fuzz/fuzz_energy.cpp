/* SPDX-License-Identifier: GPL-2.0-or-later */

/* The PHYSICAL model never gives more light than it gets, in any channel, for any value at its
 * sockets: the reflectance from sampled directions, one in each cell of a grid of the two random
 * numbers. */

#include <algorithm>

#include "fuzz_physical_input.h"

using namespace icwafer;

extern "C" int LLVMFuzzerTestOneInput(const uint8_t *bytes, const size_t size)
{
  fuzz::Input input(bytes, size);
  const PhysicalParams p = fuzz::physical_input(input);
  const LocalDirection o = input.direction();
  if (!(o.n > 0.0f)) {
    return 0;
  }
  const PhysicalView view = physical_view(p, o, fuzz::tables);

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
        const Rgb f = (i.n / physical_pdf(p, view, o, i)) * physical_eval(p, i, o, fuzz::tables);
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
  return 0;
}

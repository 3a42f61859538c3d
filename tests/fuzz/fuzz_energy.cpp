/* SPDX-License-Identifier: GPL-2.0-or-later */

/* The PHYSICAL model never gives more light than it gets, in any channel, for any value at its
 * sockets. */

#include <algorithm>

#include "fuzz_physical_input.h"

using namespace icwafer;

namespace {

/* Whether the reflectance seems to be above 1 in some channel, from sampled directions: one at
 * random in each cell of a grid of the two random numbers. */
bool seems_to_gain(const PhysicalParams &p,
                   const PhysicalView &view,
                   const LocalDirection o,
                   const int cells,
                   test::Random &random)
{
  double sum[3] = {0.0, 0.0, 0.0}, squares[3] = {0.0, 0.0, 0.0};
  for (int a = 0; a < cells; a++) {
    for (int b = 0; b < cells; b++) {
      const float across = (float(a) + test::uniform(random)) / float(cells);
      const float along = (float(b) + test::uniform(random)) / float(cells);
      const LocalDirection i = physical_sample(
          p, view, o, std::min(across, 1.0f - 0x1p-24f), std::min(along, 1.0f - 0x1p-24f));
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
  const double count = double(cells) * cells;
  for (int c = 0; c < 3; c++) {
    const double mean = sum[c] / count;
    const double error = std::sqrt(std::max(squares[c] / count - mean * mean, 0.0) / count);
    if (mean > 1.001 + 4.0 * error) {
      return true;
    }
  }
  return false;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t *bytes, const size_t size)
{
  fuzz::Input input(bytes, size);
  const PhysicalParams p = fuzz::physical_input(input);
  const LocalDirection o = input.direction();
  if (!(o.n > 0.0f)) {
    return 0;
  }
  const PhysicalView view = physical_view(p, o, fuzz::tables);

  /* Among many inputs a few seem to, by chance: those are sampled more finely, twice. */
  test::Random random(1);
  FUZZ_EXPECT(!(seems_to_gain(p, view, o, 24, random) && seems_to_gain(p, view, o, 96, random) &&
                seems_to_gain(p, view, o, 384, random)));
  return 0;
}

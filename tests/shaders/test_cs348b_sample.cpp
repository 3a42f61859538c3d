/* SPDX-License-Identifier: GPL-2.0-or-later */

/* How much noise the sampling of CS348B leaves. That it follows its density is in
 * test_models.cpp. */

#include <gtest/gtest.h>

#include "support.h"

namespace icwafer::test {

/* The density is close enough to what is reflected that a few samples suffice: the second moment
 * of f cos / pdf over its squared mean is the variance of one sample, plus one. */
TEST(Importance, VarianceIsLowAtTheDefaults)
{
  const ColourTable table = colour_table(working_spaces[0].xyz_to_rgb);
  const TableSensitivity sensitivity(table);
  Random random(7);
  const Cs348bParams p = cs348b_params(
      1000.0f, 250.0f, 530.0f, 1.544f, 0.015f, 0.0f, cs348b_grating | cs348b_wire_diffraction);
  const LocalDirection o = direction(0.3f, 0.2f);
  const float total = cs348b_total_power(p, o.nu);
  double by_importance[2] = {0.0, 0.0}, by_cosine[2] = {0.0, 0.0};
  constexpr int count = 200000;
  for (int k = 0; k < count; k++) {
    const auto weight = [&](const LocalDirection i, const float pdf) {
      const Rgb f = cs348b_eval(p, grating_geometry(i, o), sensitivity);
      return double((f.r + f.g + f.b) / 3.0f * i.n / pdf);
    };
    const LocalDirection i = cs348b_sample(p, total, o, uniform(random), uniform(random));
    const double a = i.n > 0.0f ? weight(i, cs348b_pdf(p, total, o, i)) : 0.0;
    by_importance[0] += a / count;
    by_importance[1] += a * a / count;
    const LocalDirection c = random_direction(random);
    const double b = c.n > 0.0f ? weight(c, c.n / pi) : 0.0;
    by_cosine[0] += b / count;
    by_cosine[1] += b * b / count;
  }
  EXPECT_NEAR(by_importance[0], by_cosine[0], 0.02 * by_cosine[0]);
  const double variance = by_importance[1] / (by_importance[0] * by_importance[0]) - 1.0;
  const double cosine_variance = by_cosine[1] / (by_cosine[0] * by_cosine[0]) - 1.0;
  RecordProperty("relative_variance", std::to_string(variance));
  RecordProperty("relative_variance_cosine", std::to_string(cosine_variance));
  EXPECT_LT(variance, 0.5);
  EXPECT_LT(variance, 0.25 * cosine_variance);
}

}  // namespace icwafer::test

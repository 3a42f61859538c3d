/* SPDX-License-Identifier: GPL-2.0-or-later */

/* Does the density that evaluation uses describe what sampling does? Pearson's chi-squared test
 * in the unit disc of direction cosines, in bins finer than a lobe. */

#include <gtest/gtest.h>

#include <boost/math/distributions/chi_squared.hpp>

#include "support.h"

namespace icwafer::test {

constexpr int set_count = 56;
constexpr int sample_count = 1000000;
constexpr int bins_along = 6;

/* Each bin along the wires is integrated in so many parts, because |v|^p has a cusp at v = 0. */
constexpr int parts_along = 12;

/* Gauss-Legendre nodes and weights of three points on [0, 1]. */
constexpr double nodes[3] = {0.1127016653792583, 0.5, 0.8872983346207417};
constexpr double weights[3] = {5.0 / 18.0, 8.0 / 18.0, 5.0 / 18.0};

class ChiSquared : public testing::TestWithParam<int> {};

TEST_P(ChiSquared, SamplesFollowThePdf)
{
  Random random(100 + GetParam());
  const Cs348bParams p = random_params(random);
  const LocalDirection o = random_direction(random);
  const float total = cs348b_total_power(p, o.nu);

  /* Across: bins of a third of the narrowest lobe. Along: each chord of the disc in equal parts,
   * so that no bin crosses the horizon. */
  const int bins_across = std::min(12000, int(std::ceil(2.0f / (p.lobe_width / 3.0f))));
  const auto bin_of = [&](const LocalDirection i) {
    const float half = std::sqrt(1.0f - i.nu * i.nu);
    const int across = std::clamp(
        int(0.5f * (i.nu + 1.0f) * float(bins_across)), 0, bins_across - 1);
    const int along = std::clamp(
        int(0.5f * (i.tau / half + 1.0f) * float(bins_along)), 0, bins_along - 1);
    return size_t(across * bins_along + along);
  };

  std::vector<int> observed(size_t(bins_across * bins_along), 0);
  int lost = 0;
  for (int k = 0; k < sample_count; k++) {
    const LocalDirection i = cs348b_sample(p, total, o, uniform(random), uniform(random));
    if (!(i.n > 0.0f)) {
      lost++;
      continue;
    }
    ASSERT_GT(cs348b_pdf(p, total, o, i), 0.0f);
    observed[bin_of(i)]++;
  }
  /* The horizon itself is hit by rounding only. */
  EXPECT_LT(lost, sample_count / 10000);

  /* Expected counts: density over solid angle times d omega = ds dt / cos theta. */
  std::vector<double> expected(observed.size(), 0.0);
  double integral = 0.0;
  for (int a = 0; a < bins_across; a++) {
    for (int x = 0; x < 3; x++) {
      const double s = -1.0 + 2.0 * (a + nodes[x]) / bins_across;
      const double half = std::sqrt(1.0 - s * s);
      const int parts = bins_along * (p.anisotropy > 0.0f ? parts_along : 1);
      for (int b = 0; b < parts; b++) {
        for (int y = 0; y < 3; y++) {
          const double t = half * (-1.0 + 2.0 * (b + nodes[y]) / parts);
          const LocalDirection i = direction(float(s), float(t));
          const double density = i.n > 0.0f ? cs348b_pdf(p, total, o, i) / double(i.n) : 0.0;
          const double area = weights[x] * weights[y] * (2.0 / bins_across) * (2.0 * half / parts);
          expected[size_t(a * bins_along + b * bins_along / parts)] += density * area *
                                                                       sample_count;
          integral += density * area;
        }
      }
    }
  }
  EXPECT_NEAR(integral, 1.0, 2e-3);

  /* Bins with few expected counts are pooled, as the test requires. */
  double statistic = 0.0, pooled_expected = 0.0, pooled_observed = 0.0;
  int bins = 0;
  const auto close_pool = [&] {
    statistic += (pooled_observed - pooled_expected) * (pooled_observed - pooled_expected) /
                 pooled_expected;
    bins++;
    pooled_expected = pooled_observed = 0.0;
  };
  for (size_t k = 0; k < observed.size(); k++) {
    pooled_expected += expected[k];
    pooled_observed += observed[k];
    if (pooled_expected >= 10.0) {
      close_pool();
    }
  }
  if (pooled_expected > 0.0) {
    close_pool();
  }
  ASSERT_GT(bins, 20);
  const boost::math::chi_squared distribution(bins - 1);
  const double probability = boost::math::cdf(boost::math::complement(distribution, statistic));
  /* Sidak: together the sets reject a correct sampler once in a hundred times. */
  const double threshold = 1.0 - std::pow(1.0 - 0.01, 1.0 / set_count);
  EXPECT_GT(probability, threshold)
      << "spacing " << p.spacing_nm << " nm, width " << p.width_nm << " nm, lobe " << p.lobe_width
      << ", p " << p.anisotropy << ", effects " << p.effects << ", view " << o.nu << " " << o.tau
      << ", bins " << bins << ", statistic " << statistic;
}

INSTANTIATE_TEST_SUITE_P(Sets, ChiSquared, testing::Range(0, set_count));

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

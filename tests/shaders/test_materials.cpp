/* SPDX-License-Identifier: GPL-2.0-or-later */

/* The optical constants that the renderer looks up, against the publications' own numbers. */

#include <gtest/gtest.h>

#include "icwafer/metal_table.h"
#include "icwafer/oxides.h"

namespace icwafer::test {

static ComplexIndex metal_index(const Metal metal, const float wavelength_nm)
{
  return metal_index_at(metal, wavelength_nm, [](const int i) { return metal_table[i]; });
}

/* Reflectance at normal incidence from air. */
static float bare_reflectance(const ComplexIndex metal)
{
  return (square(metal.n - 1.0f) + square(metal.k)) / (square(metal.n + 1.0f) + square(metal.k));
}

struct PublishedIndex {
  Metal metal;
  float wavelength_nm, n, k;
};

class PublishedMetal : public testing::TestWithParam<PublishedIndex> {};

/* The tolerance is a third of what the table's linear interpolation may change in a reflectance,
 * see metal_table.h; the published n of copper themselves are given to 0.02 to 0.04. */
TEST_P(PublishedMetal, IsInTheTable)
{
  const PublishedIndex published = GetParam();
  const ComplexIndex index = metal_index(published.metal, published.wavelength_nm);
  EXPECT_NEAR(index.n, published.n, 3e-3f);
  EXPECT_NEAR(index.k, published.k, 3.5e-3f);
  EXPECT_NEAR(bare_reflectance(index), bare_reflectance({published.n, published.k}), 1e-3f);
}

INSTANTIATE_TEST_SUITE_P(Papers,
                         PublishedMetal,
                         testing::Values(
                             /* Johnson and Christy 1972, on either side of the edge and on it. */
                             PublishedIndex{metal_copper, 381.5f, 1.33f, 2.045f},
                             PublishedIndex{metal_copper, 450.9f, 1.24f, 2.397f},
                             PublishedIndex{metal_copper, 548.6f, 1.02f, 2.577f},
                             PublishedIndex{metal_copper, 582.1f, 0.70f, 2.704f},
                             PublishedIndex{metal_copper, 616.8f, 0.30f, 3.205f},
                             PublishedIndex{metal_copper, 659.5f, 0.22f, 3.747f},
                             PublishedIndex{metal_copper, 756.0f, 0.24f, 4.665f},
                             /* Rakic 1995. */
                             PublishedIndex{metal_aluminium, 442.80f, 0.6079f, 5.3676f},
                             PublishedIndex{metal_aluminium, 563.57f, 1.0728f, 6.7839f},
                             PublishedIndex{metal_aluminium, 652.25f, 1.5724f, 7.7354f},
                             /* Werner et al. 2009, experimental. */
                             PublishedIndex{metal_tungsten, 450.852f, 2.2457f, 5.1471f},
                             PublishedIndex{metal_tungsten, 551.041f, 1.3296f, 5.2379f},
                             PublishedIndex{metal_tungsten, 619.921f, 0.9330f, 6.3712f},
                             /* Green 2008. */
                             PublishedIndex{metal_silicon, 400.0f, 5.613f, 0.296f},
                             PublishedIndex{metal_silicon, 550.0f, 4.077f, 0.027968f},
                             PublishedIndex{metal_silicon, 780.0f, 3.691f, 0.0063933f}));

/* Reflectances computed independently (a transfer matrix) from the same papers. */
TEST(Metals, BareCopper)
{
  EXPECT_NEAR(bare_reflectance(metal_index(metal_copper, 450.9f)), 0.539171f, 1e-3f);
  EXPECT_NEAR(bare_reflectance(metal_index(metal_copper, 548.6f)), 0.61945f, 1e-3f);
  EXPECT_NEAR(bare_reflectance(metal_index(metal_copper, 659.5f)), 0.94333f, 1e-3f);
}

/* Everything in the table absorbs, and wavelengths outside it take its ends, not other metals'. */
TEST(Metals, EveryWavelength)
{
  for (int metal = 0; metal < metal_tabulated_count; metal++) {
    for (float nm = 380.0f; nm <= 780.0f; nm += 0.7f) {
      const ComplexIndex index = metal_index(Metal(metal), nm);
      EXPECT_GT(index.n, 0.0f);
      EXPECT_GT(index.k, 0.0f);
    }
    for (const auto &[outside, inside] : {std::pair(-1e9f, 380.0f), std::pair(1e9f, 780.0f)}) {
      EXPECT_NEAR(
          metal_index(Metal(metal), outside).n, metal_index(Metal(metal), inside).n, 1e-3f);
      EXPECT_NEAR(
          metal_index(Metal(metal), outside).k, metal_index(Metal(metal), inside).k, 1e-3f);
    }
  }
}

/* Malitson 1965, the index of fused silica at 20 degrees Celsius at the lines that he measured:
 * Hg h, Hg g, Hg e, Na D, H C, He r. */
TEST(Oxides, FusedSilica)
{
  const Cauchy silica = oxide_series(oxide_sio2, 0.0f);
  EXPECT_NEAR(cauchy_index(silica, 1.0f / 404.6561f), 1.46961f, 1e-4f);
  EXPECT_NEAR(cauchy_index(silica, 1.0f / 435.8343f), 1.46669f, 1e-4f);
  EXPECT_NEAR(cauchy_index(silica, 1.0f / 546.0740f), 1.46008f, 1e-4f);
  EXPECT_NEAR(cauchy_index(silica, 1.0f / 589.2938f), 1.45841f, 1e-4f);
  EXPECT_NEAR(cauchy_index(silica, 1.0f / 656.2725f), 1.45637f, 1e-4f);
  EXPECT_NEAR(cauchy_index(silica, 1.0f / 706.5188f), 1.45515f, 1e-4f);
}

/* The formula that Baak 1982 fitted to Philipp's 1973 data, in double, over the whole range. */
TEST(Oxides, SiliconNitride)
{
  const Cauchy nitride = oxide_series(oxide_si3n4, 0.0f);
  for (double nm = 380.0; nm <= 780.0; nm += 1.0) {
    const double squared = nm * nm;
    const double index = std::sqrt(1.0 + 2.8939 * squared / (squared - 139.67 * 139.67));
    EXPECT_NEAR(cauchy_index(nitride, 1.0f / float(nm)), index, 5e-5);
  }
}

TEST(Oxides, CustomHasNoDispersion)
{
  const Cauchy custom = oxide_series(oxide_custom, 1.7f);
  EXPECT_EQ(cauchy_index(custom, 1.0f / 380.0f), 1.7f);
  EXPECT_EQ(cauchy_index(custom, 1.0f / 780.0f), 1.7f);
}

}  // namespace icwafer::test

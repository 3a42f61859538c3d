/* SPDX-License-Identifier: GPL-2.0-or-later */

#include <gtest/gtest.h>

#include "support.h"

namespace icwafer::test {

class ColourTableTest : public testing::TestWithParam<WorkingSpace> {
 protected:
  const ColourTable mapped = colour_table(GetParam().xyz_to_rgb);
  const ColourTable exact = colour_table(GetParam().xyz_to_rgb, Gamut::Exact);
};

/* A reflectance of 1 at every wavelength, integrated as the renderer does it, is white. */
TEST_P(ColourTableTest, FlatReflectanceIsNeutral)
{
  const TableSensitivity sensitivity(mapped);
  const Rgb white = smooth_integral(
      Fringes{0.0f, 0.0f}, [](float, FringeAverage) { return 1.0f; }, sensitivity);
  EXPECT_NEAR(white.r, 1.0f, 1e-4f);
  EXPECT_NEAR(white.g, 1.0f, 1e-4f);
  EXPECT_NEAR(white.b, 1.0f, 1e-4f);
}

TEST_P(ColourTableTest, NoWavelengthIsNegative)
{
  for (const auto &rgb : mapped) {
    for (const double channel : rgb) {
      EXPECT_GE(channel, 0.0);
    }
  }
}

/* Without the mapping, a rainbow clipped to the gamut has no cyan and no yellow; with it, one
 * wavelength near 490 nm has equal green and blue, one near 575 nm equal red and green, and the
 * third channel is small. */
TEST_P(ColourTableTest, RainbowHasCyanAndYellow)
{
  const auto smallest_third = [this](int a, int b, int third, int first_nm, int last_nm) {
    double best = 1e9, ratio = 1.0;
    for (int nm = first_nm; nm <= last_nm; nm++) {
      const auto &rgb = mapped[nm - visible_first_nm];
      if (std::fabs(rgb[a] - rgb[b]) < best) {
        best = std::fabs(rgb[a] - rgb[b]);
        ratio = rgb[third] / (0.5 * (rgb[a] + rgb[b]));
      }
    }
    return ratio;
  };
  EXPECT_LT(smallest_third(1, 2, 0, 470, 530), 0.25);
  EXPECT_LT(smallest_third(0, 1, 2, 550, 610), 0.25);
}

/* What the mapping costs for broad spectra, Gaussians of reflectance with a standard deviation of
 * 80 nm: the largest difference of a channel from the exact colour, white being 1. A small working
 * space pays most (the red of a cyan in Rec.709), a wide one little. Measured: 0.32, 0.05 and
 * 0.06; the test keeps the cost from growing. */
TEST_P(ColourTableTest, CostForBroadSpectra)
{
  double worst = 0.0;
  for (double centre_nm = 400.0; centre_nm <= 700.0; centre_nm += 10.0) {
    for (int c = 0; c < 3; c++) {
      double difference = 0.0;
      for (int i = 0; i < visible_count; i++) {
        const double t = (visible_first_nm + i - centre_nm) / 80.0;
        difference += std::exp(-0.5 * t * t) * (mapped[i][c] - exact[i][c]);
      }
      worst = std::fmax(worst, std::fabs(difference));
    }
  }
  RecordProperty("largest_difference", std::to_string(worst));
  EXPECT_LT(worst, GetParam().name == "Rec709" ? 0.33 : 0.15);
}

/* The colour-matching functions are the standard's: integrals 106.8655, 106.8569, 106.8923
 * (CIE 015, 1 nm). */
TEST(Cie1931, Integrals)
{
  double sum[3] = {0.0, 0.0, 0.0};
  for (const auto &row : cie1931) {
    for (int c = 0; c < 3; c++) {
      sum[c] += row[c];
    }
  }
  EXPECT_NEAR(sum[0], 106.8655, 1e-3);
  EXPECT_NEAR(sum[1], 106.8569, 1e-3);
  EXPECT_NEAR(sum[2], 106.8923, 1e-3);
}

/* Equal-energy white through the matrix without normalisation is pink: (1.2049, 0.9482, 0.9092)
 * in Rec.709 (an independent computation). The normalisation is not a formality. */
TEST(Cie1931, EqualEnergyIsPinkWithoutNormalisation)
{
  double xyz[3] = {0.0, 0.0, 0.0}, y = 0.0;
  for (const auto &row : cie1931) {
    for (int c = 0; c < 3; c++) {
      xyz[c] += row[c];
    }
    y += row[1];
  }
  const XyzToRgb &m = working_spaces[0].xyz_to_rgb;
  const double expected[3] = {1.2049, 0.9482, 0.9092};
  for (int c = 0; c < 3; c++) {
    const double value = (m[c][0] * xyz[0] + m[c][1] * xyz[1] + m[c][2] * xyz[2]) / y;
    EXPECT_NEAR(value, expected[c], 5e-4);
  }
}

INSTANTIATE_TEST_SUITE_P(Spaces,
                         ColourTableTest,
                         testing::ValuesIn(working_spaces),
                         [](const auto &suite) { return suite.param.name; });

}  // namespace icwafer::test

/* SPDX-License-Identifier: GPL-2.0-or-later */

/* The lamps and the colour tables under them. */

#include <complex>

#include <gtest/gtest.h>

#include "support.h"

namespace icwafer::test {

struct Lamp {
  std::string name;
  Illuminant illuminant;
};

/* Google Test prints the parameters of a failing test. */
static void PrintTo(const Lamp &lamp, std::ostream *out)
{
  *out << lamp.name;
}

static const std::vector<Lamp> lamps = {{"EqualEnergy", illuminant_equal_energy},
                                        {"D65", illuminant_d65},
                                        {"A", illuminant_a},
                                        {"F2", illuminant_f2},
                                        {"F11", illuminant_f11},
                                        {"WhiteLed", illuminant_white_led},
                                        {"Sodium", illuminant_sodium}};

/* Chromaticities that CIE 015:2018 gives for the illuminants (2 degrees, 5 nm): a wrong or shifted
 * value in a table moves them. */
TEST(Illuminants, Chromaticity)
{
  const double published[illuminant_tabulated_count][2] = {{0.3127, 0.3290},  /* D65 */
                                                           {0.4476, 0.4074},  /* A */
                                                           {0.3721, 0.3751},  /* F2 */
                                                           {0.3805, 0.3769},  /* F11 */
                                                           {0.3756, 0.3723}}; /* LED-B3 */
  for (int lamp = 0; lamp < illuminant_tabulated_count; lamp++) {
    double xyz[3] = {0.0, 0.0, 0.0};
    for (int i = 0; i < illuminant_sample_count; i++) {
      const int row = visible_first_nm + i * illuminant_step_nm - cie1931_first_nm;
      for (int c = 0; c < 3; c++) {
        xyz[c] += illuminant_table[lamp][i] * cie1931[row][c];
      }
    }
    const double sum = xyz[0] + xyz[1] + xyz[2];
    EXPECT_NEAR(xyz[0] / sum, published[lamp][0], 1e-4) << lamp;
    EXPECT_NEAR(xyz[1] / sum, published[lamp][1], 1e-4) << lamp;
  }
}

class LampTest : public testing::TestWithParam<std::tuple<WorkingSpace, Lamp>> {
 protected:
  const XyzToRgb &xyz_to_rgb = std::get<0>(GetParam()).xyz_to_rgb;
  const Illuminant illuminant = std::get<1>(GetParam()).illuminant;
  const ColourTable mapped = colour_table(xyz_to_rgb, illuminant);
};

TEST_P(LampTest, FlatReflectanceIsNeutral)
{
  for (const Gamut gamut : {Gamut::Mapped, Gamut::Exact}) {
    double sum[3] = {0.0, 0.0, 0.0};
    for (const auto &rgb : colour_table(xyz_to_rgb, illuminant, gamut)) {
      for (int c = 0; c < 3; c++) {
        sum[c] += rgb[c];
      }
    }
    for (const double channel : sum) {
      EXPECT_NEAR(channel, 1.0, 1e-12);
    }
  }
}

TEST_P(LampTest, NoWavelengthIsNegative)
{
  for (const auto &rgb : mapped) {
    for (const double channel : rgb) {
      EXPECT_GE(channel, 0.0);
    }
  }
}

/* The mapping into the gamut keeps the luminance of every wavelength, which is positive under
 * every lamp, so that none turns black. */
TEST_P(LampTest, MappingKeepsLuminance)
{
  using namespace colour_table_detail;
  const std::array<double, 3> weight = luminance_weights(xyz_to_rgb);
  const auto luminance = [&](const std::array<double, 3> &rgb) {
    return weight[0] * rgb[0] + weight[1] * rgb[1] + weight[2] * rgb[2];
  };
  if (illuminant == illuminant_sodium) {
    return; /* Its table is neutral: nothing is mapped. */
  }
  ColourTable table = matched_table(xyz_to_rgb);
  normalise_channels(table, lamp_power(illuminant));
  ColourTable moved = table;
  map_into_gamut(moved, weight);
  for (int i = 0; i < visible_count; i++) {
    EXPECT_GT(luminance(table[i]), 0.0);
    EXPECT_NEAR(luminance(moved[i]) / luminance(table[i]), 1.0, 1e-12);
    EXPECT_GE(*std::min_element(moved[i].begin(), moved[i].end()), 0.0);
  }
}

/* The stated bandwidth holds for each channel, and is no more than a quarter above what is needed.
 */
TEST_P(LampTest, Bandwidth)
{
  const double stated = illuminant_bandwidth_per_nm(illuminant);
  const auto largest_amplitude = [this](const double per_nm) {
    double largest = 0.0;
    for (int c = 0; c < 3; c++) {
      std::complex<double> sum = 0.0;
      for (int i = 0; i < visible_count; i++) {
        sum += std::polar(mapped[i][c], per_nm * i);
      }
      largest = std::max(largest, std::abs(sum));
    }
    return largest;
  };
  for (double per_nm = stated; per_nm < M_PI; per_nm += 0.01) {
    EXPECT_LT(largest_amplitude(per_nm), 1e-3) << per_nm;
  }
  EXPECT_GT(largest_amplitude(stated / 1.25), 1e-3);
}

/* The stated blur holds for each channel. */
TEST_P(LampTest, Blur)
{
  const double stated = illuminant_blur_per_nm(illuminant);
  double worst = 0.0;
  for (double path_nm = 4000.0; path_nm < 50000.0; path_nm += 50.0) {
    for (int c = 0; c < 3; c++) {
      std::complex<double> sum = 0.0;
      for (int i = 0; i < visible_count; i++) {
        sum += std::polar(mapped[i][c], 2.0 * M_PI * path_nm / (visible_first_nm + i));
      }
      worst = std::max(worst, std::abs(sum) / std::max(std::exp(-stated * path_nm), 1e-3));
    }
  }
  EXPECT_LT(worst, 1.0);
}

INSTANTIATE_TEST_SUITE_P(Lamps,
                         LampTest,
                         testing::Combine(testing::ValuesIn(working_spaces),
                                          testing::ValuesIn(lamps)),
                         [](const auto &suite) {
                           return std::get<0>(suite.param).name + std::get<1>(suite.param).name;
                         });

/* Where a channel of a table has a peak of at least a tenth of its highest, in nanometres. */
static std::vector<int> peaks(const ColourTable &table, const int channel)
{
  double highest = 0.0;
  for (const auto &rgb : table) {
    highest = std::max(highest, rgb[channel]);
  }
  std::vector<int> result;
  for (int i = 1; i + 1 < visible_count; i++) {
    const double s = table[i][channel];
    if (s > table[i - 1][channel] && s >= table[i + 1][channel] && s > 0.1 * highest) {
      result.push_back(visible_first_nm + i);
    }
  }
  return result;
}

/* The strongest lines of a three-band fluorescent tube stay separate: the mercury lines at 435.8
 * and 546.1 nm (here with the terbium of the green phosphor, which begins at 543 nm) and the
 * europium of the red phosphor at 611 nm, within the 5 nm of the lamp's table. Between green and
 * red there is next to nothing. */
TEST(Illuminants, LinesOfF11StaySeparate)
{
  for (const WorkingSpace &space : working_spaces) {
    const ColourTable table = colour_table(space.xyz_to_rgb, illuminant_f11);
    const auto has = [&](const int channel, const double line_nm) {
      for (const int nm : peaks(table, channel)) {
        if (std::fabs(nm - line_nm) <= 2.5) {
          return true;
        }
      }
      return false;
    };
    EXPECT_TRUE(has(2, 435.8)) << space.name;
    EXPECT_TRUE(has(1, 544.5)) << space.name;
    EXPECT_TRUE(has(0, 611.5)) << space.name;
    EXPECT_LT(table[565 - visible_first_nm][1], 0.06 * table[545 - visible_first_nm][1]);
  }
}

/* One colour only: the same number in every channel, and nothing away from the doublet. */
TEST(Illuminants, SodiumIsOneLine)
{
  const ColourTable table = colour_table(working_spaces[0].xyz_to_rgb, illuminant_sodium);
  double inside = 0.0, mean_nm = 0.0;
  for (int i = 0; i < visible_count; i++) {
    EXPECT_EQ(table[i][0], table[i][1]);
    EXPECT_EQ(table[i][0], table[i][2]);
    const int nm = visible_first_nm + i;
    inside += std::abs(nm - 589) <= 8 ? table[i][0] : 0.0;
    mean_nm += nm * table[i][0];
  }
  EXPECT_GT(inside, 0.9995);
  EXPECT_NEAR(mean_nm, sodium_mean_nm, 0.01);
}

}  // namespace icwafer::test

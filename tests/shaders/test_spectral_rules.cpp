/* SPDX-License-Identifier: GPL-2.0-or-later */

/* The quadrature rules of every lamp and working space. */

#include <numeric>

#include <gtest/gtest.h>

#include "icwafer/physical_reference.h"
#include "support.h"

namespace icwafer::test {

class SpectralRules : public testing::TestWithParam<std::tuple<WorkingSpace, int>> {
 protected:
  const ColourTable table = colour_table(std::get<0>(GetParam()).xyz_to_rgb,
                                         Illuminant(std::get<1>(GetParam())));

  SpectralRule rule(const int number) const
  {
    return spectral_rule(table,
                         rule_nodes(number),
                         rule_fitted_paths * rule_path_nm(number));
  }
};

TEST_P(SpectralRules, WhiteStaysWhiteAndNothingIsNegative)
{
  for (int number = 0; number < rule_count; number++) {
    const SpectralRule r = rule(number);
    ASSERT_EQ(int(r.wavelength_nm.size()), rule_nodes(number));
    EXPECT_TRUE(std::is_sorted(r.wavelength_nm.begin(), r.wavelength_nm.end()));
    EXPECT_GE(r.wavelength_nm.front(), visible_first_nm);
    EXPECT_LE(r.wavelength_nm.back(), visible_last_nm);
    for (const std::vector<double> &weight : r.weight) {
      EXPECT_NEAR(std::accumulate(weight.begin(), weight.end(), 0.0), 1.0, 1e-12);
      EXPECT_GE(*std::min_element(weight.begin(), weight.end()), 0.0);
    }
  }
}

/* Reflectance of films on metals, light's path in them up to the rule's, against one wavelength for
 * each nanometre. */
TEST_P(SpectralRules, FilmsHaveTheirColour)
{
  std::mt19937 random(1);
  const auto uniform = [&random](const double low, const double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  for (int number = 0; number < rule_count; number++) {
    const SpectralRule r = rule(number);
    const double longest = rule_path_nm(number);
    double squares = 0.0;
    const int films = 60;
    for (int k = 0; k < films; k++) {
      const double thickness = uniform(0.0, longest / 2.0 / 1.47), cosine = uniform(0.15, 1.0);
      const int metal = k % metal_tabulated_count;
      const auto reflectance = [&](const double nm) {
        const ComplexIndex index = material_tables_detail::index_of(metal, nm);
        const auto amplitude = reference::film_on_metal(
            cosine, 1.46, {index.n, index.k}, thickness, nm);
        return 0.5 * (std::norm(amplitude[0]) + std::norm(amplitude[1]));
      };
      for (int channel = 0; channel < 3; channel++) {
        double exact = 0.0, quick = 0.0;
        for (int i = 0; i < visible_count; i++) {
          exact += table[i][channel] * reflectance(visible_first_nm + i);
        }
        for (size_t node = 0; node < r.wavelength_nm.size(); node++) {
          quick += r.weight[channel][node] * reflectance(r.wavelength_nm[node]);
        }
        squares += (quick / exact - 1.0) * (quick / exact - 1.0);
      }
    }
    EXPECT_LT(std::sqrt(squares / (3 * films)), 0.005) << "rule " << number;
  }
}

INSTANTIATE_TEST_SUITE_P(All,
                         SpectralRules,
                         testing::Combine(testing::ValuesIn(working_spaces),
                                          testing::Range(0, int(illuminant_count))));

}  // namespace icwafer::test

/* SPDX-License-Identifier: GPL-2.0-or-later */

/* Films on metal, in double, against numbers computed independently (a transfer matrix that
 * equals Airy's sum to 1e-12): SiO2 of Malitson, 300 nm, on copper of Johnson and Christy and on
 * aluminium of Rakic. */

#include <gtest/gtest.h>

#include "icwafer/film.h"
#include "support.h"

namespace icwafer::test {

/* Malitson 1965, lengths in micrometres. */
static double silica_index(const double wavelength_um)
{
  const double square_um = wavelength_um * wavelength_um;
  double sum = 1.0;
  for (const auto &[strength, resonance_um] : {std::pair(0.6961663, 0.0684043),
                                              std::pair(0.4079426, 0.1162414),
                                              std::pair(0.8974794, 9.896161)}) {
    sum += strength * square_um / (square_um - resonance_um * resonance_um);
  }
  return std::sqrt(sum);
}

template<typename Real> static Real real(const double x)
{
  return Real{} + float(x);
}

template<> double real<double>(const double x)
{
  return x;
}

/* Ridges under 300 nm of oxide, grooves under 600 nm. */
template<typename Real>
static PolarisedFilmPair<Real> oxide_film(const double cosine,
                                          const Complex<double> metal,
                                          const double wavelength_um)
{
  return film_on_metal<Real>(real<Real>(cosine),
                             real<Real>(silica_index(wavelength_um)),
                             {real<Real>(metal.re), real<Real>(metal.im)},
                             real<Real>(0.3 / wavelength_um),
                             real<Real>(0.6 / wavelength_um));
}

struct Copper {
  double wavelength_um;
  Complex<double> metal;
  double bare, normal;
  /* {s, p} at 30 and 60 degrees. */
  double at_30[2], at_60[2];
};

static const Copper copper[] = {
    {0.4509, {1.24, 2.397}, 0.539171, 0.5601, {0.623404, 0.526303}, {0.556354, 0.367051}},
    {0.5486, {1.02, 2.577}, 0.61945, 0.555554, {0.485499, 0.465587}, {0.443813, 0.496095}},
    {0.6595, {0.22, 3.747}, 0.94333, 0.894763, {0.913834, 0.903947}, {0.967951, 0.904926}},
};

constexpr double tolerance = 1e-6;

TEST(Film, OxideOnCopper)
{
  for (const Copper &c : copper) {
    const auto normal = oxide_film<double>(1.0, c.metal, c.wavelength_um);
    EXPECT_NEAR(normal.s.ridge, c.normal, tolerance);
    EXPECT_NEAR(normal.p.ridge, c.normal, tolerance);
    const auto at_30 = oxide_film<double>(std::cos(M_PI / 6.0), c.metal, c.wavelength_um);
    EXPECT_NEAR(at_30.s.ridge, c.at_30[0], tolerance);
    EXPECT_NEAR(at_30.p.ridge, c.at_30[1], tolerance);
    const auto at_60 = oxide_film<double>(0.5, c.metal, c.wavelength_um);
    EXPECT_NEAR(at_60.s.ridge, c.at_60[0], tolerance);
    EXPECT_NEAR(at_60.p.ridge, c.at_60[1], tolerance);
  }
}

TEST(Film, BareCopper)
{
  for (const Copper &c : copper) {
    const auto bare = film_on_metal<double>(
        1.0, silica_index(c.wavelength_um), c.metal, 0.0, 0.0);
    EXPECT_NEAR(bare.s.ridge, c.bare, tolerance);
    EXPECT_NEAR(bare.p.groove, c.bare, tolerance);
    EXPECT_EQ(bare.s.contrast, 0.0);
  }
}

TEST(Film, OxideOnAluminium)
{
  const struct {
    double wavelength_um;
    Complex<double> metal;
    double expected;
  } cases[] = {{0.4428, {0.6079, 5.3676}, 0.923352},
               {0.56357, {1.0728, 6.7839}, 0.851188},
               {0.65225, {1.5724, 7.7354}, 0.830044}};
  for (const auto &c : cases) {
    const auto pair = oxide_film<double>(1.0, c.metal, c.wavelength_um);
    EXPECT_NEAR(pair.s.ridge, c.expected, tolerance);
    EXPECT_NEAR(pair.p.ridge, c.expected, tolerance);
  }
}

/* In float, as a renderer computes it: the phase is what loses most, 2 n h / lambda turns. */
TEST(Film, FloatIsCloseToDouble)
{
  Random random(1);
  for (int k = 0; k < 10000; k++) {
    const double cosine = uniform(random, 0.01f, 1.0f), wavelength_um = uniform(random, 0.4f, 0.7f);
    const Complex<double> metal = {log_uniform(random, 0.02f, 5.0f),
                                   log_uniform(random, 0.1f, 10.0f)};
    const auto expected = unpolarised(oxide_film<double>(cosine, metal, wavelength_um));
    const auto actual = unpolarised(oxide_film<Lanes>(cosine, metal, wavelength_um));
    EXPECT_NEAR(get_lane(actual.ridge, 0), expected.ridge, 5e-5);
    EXPECT_NEAR(get_lane(actual.groove, 0), expected.groove, 5e-5);
    EXPECT_NEAR(get_lane(actual.contrast, 0), expected.contrast, 1e-4);
  }
}

}  // namespace icwafer::test

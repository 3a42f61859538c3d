/* SPDX-License-Identifier: GPL-2.0-or-later */

#include <gtest/gtest.h>

#include "icwafer/reference.h"
#include "support.h"

namespace icwafer::test {

static const ColourTable rec709 = colour_table(working_spaces[0].xyz_to_rgb);
static const TableSensitivity sensitivity(rec709);

/* ---- Against brute force ---- */

struct Case {
  float spacing_nm, lobe_width;
  int effects;
};

class AgainstReference : public testing::TestWithParam<Case> {};

/* RMS of the difference over the deflections u that two directions can have, relative to the RMS
 * of the reference. */
TEST_P(AgainstReference, WithinHalfAPercent)
{
  const auto [spacing_nm, lobe_width, effects] = GetParam();
  const Cs348bParams p = cs348b_params(
      spacing_nm, 0.25f * spacing_nm, 530.0f, 1.544f, lobe_width, 0.0f, effects);
  double difference = 0.0, power = 0.0;
  /* Steps finer than the narrowest lobe. */
  constexpr int steps = 1600;
  for (int k = 0; k < steps; k++) {
    const float u = 1.9f * (float(k) + 0.5f) / float(steps);
    const LocalDirection w = direction(0.5f * u, 0.1f);
    const GratingGeometry g = grating_geometry(w, w);
    const Rgb fast = cs348b_eval(p, g, sensitivity);
    const reference::Rgb slow = reference::cs348b_eval(p, g, rec709);
    const double d[3] = {fast.r - slow.r, fast.g - slow.g, fast.b - slow.b};
    difference += d[0] * d[0] + d[1] * d[1] + d[2] * d[2];
    power += slow.r * slow.r + slow.g * slow.g + slow.b * slow.b;
  }
  EXPECT_LT(std::sqrt(difference / power), 0.005);
}

static std::vector<Case> reference_cases()
{
  std::vector<Case> cases;
  for (const float spacing_nm : {600.0f, 800.0f, 1000.0f, 1500.0f, 2000.0f, 3000.0f, 4000.0f}) {
    for (const float lobe_width : {0.002f, 0.005f, 0.01f, 0.02f, 0.05f}) {
      for (const int film : {0, int(cs348b_thin_film)}) {
        cases.push_back({spacing_nm, lobe_width, cs348b_grating | cs348b_wire_diffraction | film});
      }
    }
  }
  cases.push_back({1000.0f, 0.01f, cs348b_thin_film});
  cases.push_back({1000.0f, 0.01f, cs348b_wire_diffraction});
  cases.push_back({1000.0f, 0.01f, cs348b_grating});
  return cases;
}

INSTANTIATE_TEST_SUITE_P(Range,
                         AgainstReference,
                         testing::ValuesIn(reference_cases()),
                         [](const auto &suite) {
                           return "d" + std::to_string(int(suite.param.spacing_nm)) + "_lobe" +
                                  std::to_string(int(1000.0f * suite.param.lobe_width + 0.5f)) +
                                  "_effects" + std::to_string(suite.param.effects);
                         });

/* Parameters at random, thick films, wide wires and grazing light among them. */
TEST(Cs348b, AgreesWithReferenceAtRandom)
{
  Random random(1);
  double difference = 0.0, power = 0.0;
  for (int k = 0; k < 4000; k++) {
    const Cs348bParams p = random_params(random);
    const GratingGeometry g = grating_geometry(random_direction(random), random_direction(random));
    const Rgb fast = cs348b_eval(p, g, sensitivity);
    const reference::Rgb slow = reference::cs348b_eval(p, g, rec709);
    /* Each case counts alike, however bright it is; a hundredth of a lobe's height is dark. */
    const double width = p.lobe_width * p.spacing_nm / 550.0;
    const double scale = slow.r + slow.g + slow.b + 0.01 / std::fmin(width, 1.0);
    const double d[3] = {fast.r - slow.r, fast.g - slow.g, fast.b - slow.b};
    difference += (d[0] * d[0] + d[1] * d[1] + d[2] * d[2]) / (scale * scale);
    power += (slow.r * slow.r + slow.g * slow.g + slow.b * slow.b) / (scale * scale);
  }
  EXPECT_LT(std::sqrt(difference / power), 0.005);
}

/* ---- The law of the directions ---- */

/* Light at 60 degrees along the wires of a 2 um grating: order 1 of 550 nm leaves at
 * (0.275, -0.866025, 0.417582) (exact conical law). With a lobe of 1e-4 and an eye that sees
 * 550 nm only, the power over u has its mean there, to 1e-6. */
TEST(Cs348b, DirectionLawIsExact)
{
  const Cs348bParams p = cs348b_params(2000.0f, 500.0f, 0.0f, 1.5f, 1e-4f, 0.0f, cs348b_grating);
  const LocalDirection i = direction(0.0f, std::sqrt(0.75f));
  for (int order = 1; order <= 3; order++) {
    const double expected = order * 550.0 / 2000.0;
    double sum = 0.0, first = 0.0;
    for (int k = -200; k <= 200; k++) {
      const double u = expected + k * 5e-6;
      const LocalDirection o = direction(float(u), -i.tau);
      const GratingGeometry g = grating_geometry(i, o);
      EXPECT_EQ(g.v, 0.0f);
      const double lobe = order_lobes(g.u * p.spacing_nm / 550.0f,
                                      p.lobe_width * p.spacing_nm / 550.0f);
      sum += lobe;
      first += lobe * g.u;
    }
    EXPECT_NEAR(first / sum, expected, 1e-6);
    const LocalDirection o = direction(float(expected), -i.tau);
    if (order == 1) {
      EXPECT_NEAR(o.nu, 0.275, 1e-6);
      EXPECT_NEAR(o.tau, -0.866025, 1e-6);
      EXPECT_NEAR(o.n, 0.417582, 1e-6);
    }
  }
}

/* The same through the whole evaluation: for green light (a table with one wavelength) the
 * brightest u of each order is where the law says. */
TEST(Cs348b, BrightestDirectionFollowsTheLaw)
{
  for (const int nm : {450, 550, 650}) {
    const auto line = [nm](const float wavelength) {
      const float s = std::exp(-0.5f * square((wavelength - float(nm)) / 4.0f));
      return Rgb{s, s, s};
    };
    const Cs348bParams p = cs348b_params(
        1600.0f, 100.0f, 0.0f, 1.5f, 0.004f, 0.0f, cs348b_grating | cs348b_wire_diffraction);
    for (int order = 1; order <= 2; order++) {
      const float expected = float(order * nm) / p.spacing_nm;
      double sum = 0.0, first = 0.0;
      for (float u = expected - 0.04f; u < expected + 0.04f; u += 1e-4f) {
        const LocalDirection i = direction(0.3f, 0.5f);
        const Rgb f = cs348b_eval(p, grating_geometry(i, direction(u - i.nu, -i.tau)), line);
        sum += f.g;
        first += f.g * u;
      }
      EXPECT_NEAR(first / sum, expected, 5e-4);
    }
  }
}

/* ---- The published factors ---- */

/* delta -> Gaussian keeps the area: over all u, order k holds lambda / (pi D), whatever the
 * lobe's width. */
TEST(Cs348b, LobeWidthKeepsEnergy)
{
  double energy[3];
  int n = 0;
  for (const float lobe_width : {0.002f, 0.01f, 0.04f}) {
    const Cs348bParams p = cs348b_params(
        1000.0f, 250.0f, 0.0f, 1.5f, lobe_width, 0.0f, cs348b_grating | cs348b_wire_diffraction);
    double sum = 0.0;
    constexpr double step = 5e-4;
    for (double u = -1.9; u < 1.9; u += step) {
      const LocalDirection w = direction(float(0.5 * u), 0.0f);
      sum += cs348b_eval(p, grating_geometry(w, w), sensitivity).g * step;
    }
    energy[n++] = sum;
  }
  EXPECT_NEAR(energy[1] / energy[0], 1.0, 0.005);
  EXPECT_NEAR(energy[2] / energy[0], 1.0, 0.01);

  /* Orders 0, +-1, +-2 and +-3 of green light, 2 sum_k lambda / (pi D) sinc^2(k / 4). */
  double expected = 0.0;
  for (int k = -3; k <= 3; k++) {
    const double a = M_PI * k * 0.25;
    expected += k == 0 ? 1.0 : std::pow(std::sin(a) / a, 2);
  }
  EXPECT_NEAR(energy[0], expected * 0.547 / M_PI, 0.01);
}

/* In the mirror direction g is the textbook's phase of a film, (2 pi / lambda) n H cos phi. */
TEST(Cs348b, FilmPathInTheMirrorDirection)
{
  for (const float degrees : {0.0f, 30.0f, 60.0f}) {
    const float s = std::sin(degrees * pi / 180.0f), c = std::cos(degrees * pi / 180.0f);
    const GratingGeometry g = grating_geometry({0.6f * s, 0.8f * s, c}, {-0.6f * s, -0.8f * s, c});
    EXPECT_NEAR(cs348b_film_path_nm(818.32f, g), 2.0f * 818.32f * c, 1e-2f);
  }
}

/* Each effect that is off is the factor 1, or for the grating its mean 1 / pi. */
TEST(Cs348b, EffectsSwitchOffAlone)
{
  const GratingGeometry g = grating_geometry(direction(0.3f, 0.2f), direction(0.25f, -0.1f));
  const auto eval = [&g](const int effects) {
    return cs348b_eval(
        cs348b_params(1000.0f, 250.0f, 530.0f, 1.544f, 0.02f, 0.0f, effects), g, sensitivity);
  };
  const Rgb none = eval(0);
  EXPECT_NEAR(none.r, 1.0f / pi, 1e-4f);
  EXPECT_NEAR(none.g, 1.0f / pi, 1e-4f);
  EXPECT_NEAR(none.b, 1.0f / pi, 1e-4f);
  const Rgb film = eval(cs348b_thin_film);
  EXPECT_GT(std::fabs(film.r - film.b), 0.02f);
  const Rgb slit = eval(cs348b_wire_diffraction);
  EXPECT_LT(std::fabs(slit.r - slit.b), 0.1f * slit.g);
}

TEST(Cs348b, AnisotropyIsAPowerOfV)
{
  const GratingGeometry g = grating_geometry(direction(0.3f, 0.2f), direction(0.25f, 0.3f));
  Cs348bParams p = cs348b_params(1000.0f, 250.0f, 530.0f, 1.544f, 0.02f, 0.0f, cs348b_all_effects);
  const float without = cs348b_eval(p, g, sensitivity).g;
  p.anisotropy = 2.0f;
  EXPECT_NEAR(cs348b_eval(p, g, sensitivity).g, 0.25f * without, 1e-5f * without);
}

/* Both regimes of the sum over orders agree where they meet, and with the plain sum. */
TEST(OrderLobes, RegimesMeet)
{
  for (float x = -2.0f; x < 2.0f; x += 0.01f) {
    EXPECT_NEAR(order_lobes(x, 0.49999f), order_lobes(x, 0.5f), 2e-4f);
    for (const float w : {0.05f, 0.2f, 0.45f, 0.55f, 1.5f}) {
      const double expected = reference::order_lobes(x, w);
      EXPECT_NEAR(order_lobes(x, w), expected, 2e-5 + 2e-5 * expected);
    }
  }
}

}  // namespace icwafer::test

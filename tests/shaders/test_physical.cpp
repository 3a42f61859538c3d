/* SPDX-License-Identifier: GPL-2.0-or-later */

/* The PHYSICAL model's evaluation against the same formulas by brute force, and the laws of
 * direction and energy. */

#include <gtest/gtest.h>

#include "icwafer/physical_reference.h"
#include "models.h"

namespace icwafer::test {

static const MaterialTables<ReadFloats> tables = rec709_tables();

static const ColourTable &lamp_table(const Illuminant illuminant)
{
  static const std::vector<ColourTable> lamps = [] {
    std::vector<ColourTable> result;
    for (int lamp = 0; lamp < illuminant_count; lamp++) {
      result.push_back(colour_table(working_spaces[0].xyz_to_rgb, Illuminant(lamp)));
    }
    return result;
  }();
  return lamps[illuminant];
}

/* ---- The functions of lanes.h ---- */

template<typename Function, typename Expected>
static void expect_lanes(const float low,
                         const float high,
                         const double tolerance,
                         const Function &function,
                         const Expected &expected)
{
  for (int k = 0; k <= 100000; k++) {
    const float x = low + (high - low) * float(k) / 100000.0f;
    const double value = expected(double(x));
    ASSERT_NEAR(get_lane(function(lanes(x)), k % lane_count), value, tolerance * std::fabs(value))
        << x;
  }
}

TEST(Lanes, AgreeWithTheLibrary)
{
  expect_lanes(-30.0f, 30.0f, 1e-6, lanes_exp2, [](const double x) { return std::exp2(x); });
  expect_lanes(0.0f, 1000.0f, 1e-6, lanes_sqrt, [](const double x) { return std::sqrt(x); });
  /* The exponent is rounded to float before: 1e-6 of it is relative error of the result. */
  expect_lanes(
      -4.0f, 4.0f, 2e-6, lanes_bell, [](const double x) { return std::exp(-0.5 * x * x); });
  /* Where sine and cosine vanish, turns themselves end in rounding. */
  for (int k = -100000; k <= 100000; k++) {
    const float turns = float(k) * 1.7e-4f;
    Lanes sine, cosine;
    lanes_sincos_turns(lanes(turns), sine, cosine);
    ASSERT_NEAR(get_lane(sine, 0), std::sin(2.0 * M_PI * turns), 1e-6) << turns;
    ASSERT_NEAR(get_lane(cosine, 0), std::cos(2.0 * M_PI * turns), 1e-6) << turns;
    ASSERT_NEAR(get_lane(lanes_sin_turns(lanes(turns)), 0), get_lane(sine, 0), 1e-7);
    ASSERT_NEAR(get_lane(lanes_cos_turns(lanes(turns)), 0), get_lane(cosine, 0), 1e-7);
  }
}

/* ---- The sum over orders ---- */

static double plain_order_sum(const double x,
                              const double w_0,
                              const double duty,
                              const double variation)
{
  const double w = std::sqrt(w_0 * w_0 + variation * variation * x * x);
  const int reach = int(std::ceil(10.0 * w)) + 2, nearest = int(std::round(x));
  double sum = 0.0;
  for (int m = nearest - reach; m <= nearest + reach; m++) {
    if (m != 0) {
      const double w_m = std::sqrt(w_0 * w_0 + variation * variation * m * m);
      const double t = (x - m) / w_m;
      sum += std::pow(std::sin(M_PI * m * duty) / (M_PI * m), 2) * std::exp(-0.5 * t * t) /
             (w_m * std::sqrt(2.0 * M_PI));
    }
  }
  return sum;
}

/* RMS over x, relative to the RMS of the plain sum, as for colours below. */
TEST(OrderSum, AgreesWithThePlainSum)
{
  for (const float w : {0.02f, 0.1f, 0.3f, 0.6f, 1.0f, 3.0f, 10.0f, 40.0f}) {
    for (const float duty : {0.02f, 0.1f, 0.25f, 0.5f, 0.8f, 0.97f}) {
      for (const float variation : {0.0f, 0.02f, 0.15f}) {
        double difference = 0.0, power = 0.0;
        for (int k = 0; k < 400; k++) {
          const float x = 6.0f * std::max(w, 1.0f) * float(k) / 400.0f;
          const double expected = plain_order_sum(x, w, duty, variation);
          const double d = get_lane(order_sum(lanes(x), lanes(w), duty, variation), 0) - expected;
          difference += d * d;
          power += expected * expected;
        }
        /* Far-reaching lobes of the outer orders are cut off. */
        EXPECT_LT(std::sqrt(difference / power), variation > 0.1f ? 0.007 : 0.005)
            << "w " << w << ", duty " << duty << ", variation " << variation;
      }
    }
  }
}

/* ---- Evaluation against brute force ---- */

/* The integral over the spectrum as the colour table defines it: a sum over whole nanometres. */
static reference::Rgb reference_eval(const PhysicalParams &p,
                                     const LocalDirection i,
                                     const LocalDirection o)
{
  const ColourTable &table = lamp_table(p.illuminant);
  reference::Rgb sum = {0.0, 0.0, 0.0};
  for (int cell = 0; cell < visible_count; cell++) {
    const double light = table[cell][0] + table[cell][1] + table[cell][2];
    if (light > 1e-7) {
      const double f = reference::physical_spectral(p, i, o, visible_first_nm + cell);
      sum.r += f * table[cell][0];
      sum.g += f * table[cell][1];
      sum.b += f * table[cell][2];
    }
  }
  return sum;
}

/* RMS of the difference over a range of the deflection u, relative to the RMS of the reference. */
static double relative_rms(const PhysicalParams &p,
                           const float u_begin,
                           const float u_end,
                           const float v = 0.0f)
{
  double difference = 0.0, power = 0.0;
  constexpr int steps = 30;
  for (int k = 0; k < steps; k++) {
    const float u = u_begin + (u_end - u_begin) * (float(k) + 0.5f) / float(steps);
    const LocalDirection i = direction(0.5f * u, 0.1f), o = direction(0.5f * u, v - 0.1f);
    const Rgb fast = physical_eval(p, i, o, tables);
    const reference::Rgb slow = reference_eval(p, i, o);
    const double d[3] = {fast.r - slow.r, fast.g - slow.g, fast.b - slow.b};
    difference += d[0] * d[0] + d[1] * d[1] + d[2] * d[2];
    power += slow.r * slow.r + slow.g * slow.g + slow.b * slow.b;
  }
  return std::sqrt(difference / power);
}

static PhysicalParams params_of(const float spacing_nm,
                                const float coherence_um,
                                const Illuminant illuminant = illuminant_equal_energy,
                                const float variation = 0.0f,
                                const float oxide_nm = 530.0f,
                                const float duty = 0.3f,
                                const float cross_nm = 0.0f)
{
  return physical_params(physical_lattice(spacing_nm, duty * spacing_nm, coherence_um),
                         physical_lattice(cross_nm, 0.2f * cross_nm, coherence_um),
                         oxide_nm,
                         300.0f,
                         0.0f,
                         variation,
                         oxide_sio2,
                         1.5f,
                         metal_copper,
                         illuminant);
}

/* The mirror order, and all others to the largest deflection: its peak is many times as bright
 * as they are. */
static void expect_agreement(const PhysicalParams &p)
{
  const PhysicalSurface surface(p);
  const float sigma = std::sqrt(physical_lobe_variance(p, p.across));
  EXPECT_LT(relative_rms(p, 0.0f, 3.0f * sigma), 0.005) << surface.description();
  /* The orders of fine wires begin where u cannot reach. */
  if (p.across.spacing_nm > 300.0f) {
    EXPECT_LT(relative_rms(p, 9.0f * sigma, 1.9f), 0.005) << surface.description();
  }
}

class Spacing : public testing::TestWithParam<float> {};

TEST_P(Spacing, AgreesWithTheReference)
{
  for (const float coherence_um : {2.0f, 5.0f, 15.0f, 40.0f, 100.0f}) {
    expect_agreement(params_of(GetParam(), coherence_um));
  }
}

INSTANTIATE_TEST_SUITE_P(Range,
                         Spacing,
                         testing::Values(200.0f,
                                         400.0f,
                                         600.0f,
                                         1000.0f,
                                         2000.0f,
                                         4000.0f,
                                         8000.0f,
                                         20000.0f,
                                         60000.0f,
                                         200000.0f));

class Lamp : public testing::TestWithParam<int> {};

TEST_P(Lamp, AgreesWithTheReference)
{
  const Illuminant illuminant = Illuminant(GetParam());
  for (const float coherence_um : {3.0f, 15.0f, 60.0f}) {
    for (const float spacing_nm : {700.0f, 3000.0f, 30000.0f}) {
      /* Sodium's peaks are too narrow to be met by so few directions. */
      if (illuminant != illuminant_sodium) {
        expect_agreement(params_of(spacing_nm, coherence_um, illuminant));
      }
    }
    /* Closer, around the place of the first order of the brightest line. */
    const float u = illuminant == illuminant_sodium ? sodium_mean_nm / 700.0f : 545.0f / 700.0f;
    const float half = 0.01f + 0.4f / coherence_um;
    EXPECT_LT(relative_rms(params_of(700.0f, coherence_um, illuminant), u - half, u + half), 0.005)
        << coherence_um;
  }
}

INSTANTIATE_TEST_SUITE_P(All, Lamp, testing::Range(0, int(illuminant_count)));

class Film : public testing::TestWithParam<float> {};

TEST_P(Film, AgreesWithTheReference)
{
  for (const float variation : {0.0f, 0.02f, 0.1f}) {
    for (const float duty : {0.05f, 0.5f}) {
      for (const float spacing_nm : {500.0f, 1500.0f, 10000.0f}) {
        expect_agreement(
            params_of(spacing_nm, 20.0f, illuminant_equal_energy, variation, GetParam(), duty));
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Thickness,
                         Film,
                         testing::Values(0.0f, 530.0f, 1500.0f, 3000.0f, 5000.0f));

/* Wires that cross: along the first orders of either family, and between them. */
TEST(Cross, AgreesWithTheReference)
{
  for (const float cross_nm : {900.0f, 3000.0f, 20000.0f}) {
    const PhysicalParams p = params_of(
        1200.0f, 10.0f, illuminant_equal_energy, 0.01f, 530.0f, 0.3f, cross_nm);
    for (const float v : {0.0f, 545.0f / cross_nm}) {
      EXPECT_LT(relative_rms(p, 0.1f, 1.8f, v), 0.005) << cross_nm << " " << v;
    }
    EXPECT_LT(relative_rms(p, 0.0f, 0.05f, 0.02f), 0.005) << cross_nm;
  }
}

/* ---- No seams ---- */

/* The evaluation chooses between ways to integrate. Slowly across their borders, colours move by
 * no more than they do within one way: a step of a hundredth of a percent of the spacing changes
 * them by less than 0.5 % of the brightest. */
TEST(Seams, SpacingAndDeflectionAreContinuous)
{
  Random random(4);
  for (int set = 0; set < 150; set++) {
    const float coherence_um = log_uniform(random, 2.0f, 30.0f);
    const float begin_nm = log_uniform(random, 400.0f, 150000.0f);
    const float u = uniform(random, 0.15f, 1.8f);
    const LocalDirection i = direction(0.5f * u, 0.1f), o = direction(0.5f * u, -0.1f);
    Rgb before = {};
    /* Some orders pass u. */
    const float end_nm = begin_nm + 1000.0f / u;
    float largest = 0.0f, jump = 0.0f;
    const int steps = 2000;
    Rgb second = {};
    for (int k = 0; k <= steps; k++) {
      const float spacing_nm = begin_nm + (end_nm - begin_nm) * float(k) / float(steps);
      const Rgb f = physical_eval(params_of(spacing_nm, coherence_um), i, o, tables);
      largest = std::max({largest, f.r, f.g, f.b});
      if (k >= 2) {
        /* What a straight line through the two before does not foresee. */
        for (const float d : {f.r - 2.0f * before.r + second.r,
                              f.g - 2.0f * before.g + second.g,
                              f.b - 2.0f * before.b + second.b}) {
          jump = std::max(jump, std::fabs(d));
        }
      }
      second = before;
      before = f;
    }
    EXPECT_LT(jump, 0.005f * largest) << begin_nm << " nm, u " << u << ", " << coherence_um;
  }
}

/* ---- Directions ---- */

/* A line of light at one wavelength: the metal's index stays that of the table. */
struct LineTables {
  MaterialTables<ReadFloats> tables;
  int nm;

  /* The same width as the sodium line of the colour table, for which steps are chosen. */
  void sensitivities(Illuminant, const int *cells, Lanes &red, Lanes &green, Lanes &blue) const
  {
    float s[lane_count];
    for (int lane = 0; lane < lane_count; lane++) {
      const float t = 0.5f * float(visible_first_nm + cells[lane] - nm);
      s[lane] = 0.19947114f * std::exp(-0.5f * t * t);
    }
    red = green = blue = load_lanes(s);
  }

  void metals(const Metal metal,
              const int *cells,
              Complex<Lanes> &index,
              Complex<Lanes> &next) const
  {
    tables.metals(metal, cells, index, next);
  }

  /* All nodes at the line. */
  Lanes rule_row(Illuminant, const int rule, const int row, int) const
  {
    if (row == 0) {
      return lanes(float(nm));
    }
    if (row < 4) {
      return lanes(1.0f / float(rule_nodes(rule)));
    }
    const ComplexIndex index = tables.metal(Metal((row - 4) / 2), nm - visible_first_nm);
    return lanes(row % 2 == 0 ? index.n : index.k);
  }
};

/* Order m of a line lies where the conical law says, to 1e-6 in the direction cosines, for light
 * from 60 degrees along the wires (and so off the plane in which gratings are usually drawn).
 * The strength of an order changes slowly with direction and wavelength; it is divided out. */
TEST(Direction, FollowsTheConicalLaw)
{
  const PhysicalParams p = physical_params(physical_lattice(2000.0f, 500.0f, 2000.0f),
                                           physical_lattice(0.0f, 0.0f, 2000.0f),
                                           0.0f,
                                           50.0f,
                                           0.0f,
                                           0.0f,
                                           oxide_sio2,
                                           1.5f,
                                           metal_aluminium,
                                           illuminant_sodium);
  const LocalDirection o = direction(0.0f, std::sqrt(0.75f));
  for (const int nm : {450, 550, 650}) {
    for (const int order : {-1, 1}) {
      const double expected = double(order) * nm / 2000.0;
      double sum = 0.0, u_sum = 0.0, v_sum = 0.0;
      for (int a = -300; a <= 300; a++) {
        for (int b = -8; b <= 8; b++) {
          const LocalDirection i = direction(float(expected + a * 2e-5),
                                             -o.tau + float(b) * 5e-5f);
          const double u = double(i.nu) + o.nu, v = double(i.tau) + o.tau;
          const double cosine = 0.5 * (double(i.n) + o.n);
          const double contrast = reference::physical_contrast(
              reference::physical_levels(p, cosine, 2000.0 * u / order));
          const double f = physical_eval(p, i, o, LineTables{tables, nm}).g / contrast;
          sum += f;
          u_sum += f * u;
          v_sum += f * v;
        }
      }
      ASSERT_GT(sum, 0.0);
      EXPECT_NEAR(u_sum / sum, expected, 1e-6) << nm << " " << order;
      EXPECT_NEAR(v_sum / sum, 0.0, 1e-6) << nm << " " << order;
    }
  }
}

/* Under a fluorescent tube the first order of a narrow lobe shows separate peaks at the lamp's
 * lines (mercury at 435.8 and 546.1 nm with terbium, europium at 611 nm), at the angles of the
 * law; the tables of the lamp have a value every 5 nm. */
TEST(Direction, F11ShowsItsLines)
{
  /* A film that is bright at all of them. */
  PhysicalParams p = params_of(1000.0f, 100.0f, illuminant_f11, 0.0f, 0.0f);
  p.groove_nm = 100.0f;
  std::vector<Rgb> colours;
  const auto u_of = [](const size_t k) { return 0.39f + 0.0005f * float(k); };
  for (size_t k = 0; u_of(k) < 0.75f; k++) {
    const LocalDirection i = direction(0.5f * u_of(k), 0.0f);
    colours.push_back(physical_eval(p, i, i, tables));
  }
  /* Where the channel is brightest within 15 nm of a line. */
  const auto peak_nm = [&](float Rgb::*channel, const float line_nm) {
    size_t brightest = 0;
    for (size_t k = 0; k < colours.size(); k++) {
      if (std::fabs(u_of(k) - 1e-3f * line_nm) < 0.015f &&
          colours[k].*channel > colours[brightest].*channel) {
        brightest = k;
      }
    }
    return 1000.0f * u_of(brightest);
  };
  EXPECT_NEAR(peak_nm(&Rgb::b, 435.8f), 435.8f, 2.5f);
  EXPECT_NEAR(peak_nm(&Rgb::g, 544.5f), 544.5f, 2.5f);
  EXPECT_NEAR(peak_nm(&Rgb::r, 611.0f), 611.0f, 2.5f);
  const auto green_at = [&](const float nm) {
    return colours[size_t((1e-3f * nm - 0.39f) / 0.0005f)].g;
  };
  EXPECT_LT(green_at(567.0f), 0.1f * green_at(544.5f));
}

/* ---- Energy of the orders ---- */

/* At one cosine the orders share F |r_ridge|^2 + (1 - F) |r_groove|^2 (Parseval), computed here
 * from the transfer matrix. The power of order m is the integral of f over its lobe, for pairs of
 * directions of equal height; of the orders beyond, A^2 alone is added. */
TEST(Energy, OrdersShareWhatThereIs)
{
  constexpr float duty = 0.3f, cosine = 0.45f;
  constexpr int nm = 550, last = 6;
  const PhysicalParams p = physical_params(physical_lattice(4000.0f, duty * 4000.0f, 200.0f),
                                           physical_lattice(0.0f, 0.0f, 200.0f),
                                           400.0f,
                                           260.0f,
                                           0.0f,
                                           0.0f,
                                           oxide_sio2,
                                           1.5f,
                                           metal_tungsten,
                                           illuminant_sodium);
  const auto power_of = [&](const int order) {
    double sum = 0.0;
    const double step_u = 1e-4, step_v = 4e-4;
    for (int a = -160; a <= 160; a++) {
      for (int b = -12; b <= 12; b++) {
        const double u = order * nm / 4000.0 + a * step_u, v = b * step_v;
        /* Half of u each, and tau so that both cosines are the same. */
        const double t = std::sqrt(1.0 - double(cosine) * cosine - 0.25 * (u * u + v * v));
        const double length = std::sqrt(u * u + v * v);
        const double x = length > 0.0 ? -v / length : 0.0, y = length > 0.0 ? u / length : 1.0;
        const LocalDirection i = direction(float(0.5 * u + t * x), float(0.5 * v + t * y));
        const LocalDirection o = direction(float(0.5 * u - t * x), float(0.5 * v - t * y));
        sum += double(physical_eval(p, i, o, LineTables{tables, nm}).g) * step_u * step_v;
      }
    }
    return sum;
  };
  const reference::PhysicalLevels r = reference::physical_levels(p, cosine, nm);
  double expected = 0.0;
  for (int s = 0; s < 2; s++) {
    expected += 0.5 * (duty * std::norm(r.ridge[s]) + (1.0 - duty) * std::norm(r.groove[s]));
  }
  double total = power_of(0), rest = duty * (1.0 - duty);
  for (int order = 1; order <= last; order++) {
    total += 2.0 * power_of(order);
    rest -= 2.0 * reference::physical_weight(p, order, 0);
  }
  total += rest * reference::physical_contrast(r);
  EXPECT_NEAR(total, expected, 1e-3);
}

}  // namespace icwafer::test

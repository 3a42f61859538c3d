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
  expect_lanes(-4.0f, 4.0f, 2e-6, lanes_bell, [](const double x) {
    return std::exp(-0.5 * x * x);
  });
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
        EXPECT_LT(std::sqrt(difference / power), 0.005)
            << "w " << w << ", duty " << duty << ", variation " << variation;
      }
    }
  }
}

/* ---- Evaluation against brute force ---- */

struct Case {
  std::string name;
  PhysicalParams params;
};

static void PrintTo(const Case &c, std::ostream *out)
{
  *out << c.name;
}

/* RMS of the difference over the deflections u that two directions can have, relative to the RMS
 * of the reference. The orders other than 0: at the mirror's peak, which is many times as bright,
 * the comparison is made on its own. */
static double relative_rms(const PhysicalParams &p, const float u_begin, const float u_end)
{
  double difference = 0.0, power = 0.0;
  constexpr int steps = 60;
  for (int k = 0; k < steps; k++) {
    /* Steps that no period of the orders has. */
    const float u = u_begin + (u_end - u_begin) * (float(k) + 0.3819660f) / float(steps);
    const LocalDirection i = direction(0.5f * u, 0.1f), o = direction(0.5f * u, -0.1f);
    const Rgb fast = physical_eval(p, i, o, tables);
    const reference::Rgb slow = reference::physical_eval(p, i, o, lamp_table(p.illuminant), 1);
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

}  // namespace icwafer::test
using namespace icwafer; using namespace icwafer::test;
int main(int argc,char**argv){ ::testing::InitGoogleTest(&argc,argv); int r=RUN_ALL_TESTS(); (void)r;
 for(float coh:{2.f,5.f,15.f,40.f,100.f}) for(float d:{200.f,350.f,600.f,1000.f,2000.f,4000.f,8000.f,20000.f,60000.f,200000.f}){ double s=.376*.78/coh; double e=relative_rms(params_of(d,coh),float(5.6*s),1.9f); double em=relative_rms(params_of(d,coh),0,float(3*s)); if(e>.003||em>.003) printf("coh %g d %g: orders %.4f mirror %.4f\n",coh,d,e,em);}
 for(int lamp=0;lamp<illuminant_count;lamp++) for(float coh:{3.f,15.f,60.f}) for(float d:{700.f,3000.f,30000.f}){ double s=.376*.78/coh; double e=relative_rms(params_of(d,coh,Illuminant(lamp)),float(5.6*s),1.9f); double em=relative_rms(params_of(d,coh,Illuminant(lamp)),0,float(3*s)); if(e>.003||em>.003)printf("lamp %d coh %g d %g: orders %.4f mirror %.4f\n",lamp,coh,d,e,em);}
 for(float ox:{0.f,3000.f,8000.f}) for(float var:{0.f,.02f,.1f}) for(float du:{.05f,.5f}) for(float d:{500.f,1500.f,10000.f}){float coh=20; double s=.376*.78/coh; auto p=params_of(d,coh,illuminant_equal_energy,var,ox,du); double e=relative_rms(p,float(5.6*s),1.9f); double em=relative_rms(p,0,float(3*s));  if(e>.003||em>.003)printf("ox %g var %g duty %g d %g: orders %.4f mirror %.4f\n",ox,var,du,d,e,em);}
}

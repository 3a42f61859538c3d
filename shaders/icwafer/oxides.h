/* SPDX-License-Identifier: Apache-2.0 */

/* Oxides by name: their index of refraction in the visible range, as Cauchy's series. Made by
 * data/make_oxides.py from Sellmeier formulas of the refractiveindex.info database: do not
 * edit.
 *   SiO2: I. H. Malitson, J. Opt. Soc. Am. 55, 1205 (1965)
 *   Si3N4: H. R. Philipp, J. Electrochem. Soc. 120, 295 (1973); formula of T. Baak,
 *   Appl. Opt. 21, 1069 (1982) */

#pragma once

#include "platform.h"

namespace icwafer {

enum Oxide {
  oxide_sio2,
  oxide_si3n4,
  /* Index given by the artist, the same for all wavelengths. */
  oxide_custom,
};

/* n = a + b / L^2 + c / L^4 for the wavelength L in nanometres, 380 to 780. */
struct Cauchy {
  float a, b, c;
};

/* `per_nm` is 1 / L, in as many lanes as there are wavelengths. */
template<typename Real>
ICW_DEVICE Real cauchy_index(const Cauchy series, const Real per_nm)
{
  const Real x = per_nm * per_nm;
  return series.a + x * (series.b + x * series.c);
}

/* The series of an oxide; `custom_index` is that of oxide_custom. */
ICW_DEVICE Cauchy oxide_series(const Oxide oxide, const float custom_index)
{
  switch (oxide) {
    case oxide_sio2: /* Largest error 9.0e-05. */
      return {1.447496f, 3879.468f, -4.10157e+07f};
    case oxide_si3n4: /* Largest error 2.4e-05. */
      return {1.973571f, 14067.124f, 2.85102e+08f};
    case oxide_custom:
      break;
  }
  return {custom_index, 0.0f, 0.0f};
}

}  // namespace icwafer

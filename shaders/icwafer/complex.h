/* SPDX-License-Identifier: Apache-2.0 */

/* Complex numbers over any real type, and the functions of that type that the optics needs. */

#pragma once

#include "lanes.h"

namespace icwafer {

ICW_DEVICE Lanes real_sqrt(const Lanes x)
{
  return lanes_sqrt(x);
}

template<typename Real>
struct Complex {
  Real re, im;
};

template<typename Real>
ICW_DEVICE Complex<Real> operator+(const Complex<Real> a, const Complex<Real> b)
{
  return {a.re + b.re, a.im + b.im};
}

template<typename Real>
ICW_DEVICE Complex<Real> operator-(const Complex<Real> a, const Complex<Real> b)
{
  return {a.re - b.re, a.im - b.im};
}

template<typename Real>
ICW_DEVICE Complex<Real> operator*(const Complex<Real> a, const Complex<Real> b)
{
  return {a.re * b.re - a.im * b.im, a.re * b.im + a.im * b.re};
}

template<typename Real>
ICW_DEVICE Complex<Real> operator*(const Real s, const Complex<Real> a)
{
  return {s * a.re, s * a.im};
}

template<typename Real>
ICW_DEVICE Real norm(const Complex<Real> a)
{
  return a.re * a.re + a.im * a.im;
}

/* The square root with a positive imaginary part, for im >= 0: the wave that decays into an
 * absorber. The larger part comes from the modulus, the other from it, so that neither cancels. */
template<typename Real>
ICW_DEVICE Complex<Real> decaying_sqrt(const Complex<Real> a)
{
  const Real modulus = real_sqrt(norm(a));
  const Real magnitude = a.re < 0.0f ? -a.re : a.re;
  const Real larger = real_sqrt(0.5f * (modulus + magnitude));
  const Real smaller = 0.5f * a.im / larger;
  return {a.re < 0.0f ? smaller : larger, a.re < 0.0f ? larger : smaller};
}

/* exp(2 pi i turns) */
template<typename Real>
ICW_DEVICE Complex<Real> unit_turns(const Real turns);

template<>
ICW_DEVICE Complex<Lanes> unit_turns<Lanes>(const Lanes turns)
{
  Complex<Lanes> z;
  lanes_sincos_turns(turns, z.im, z.re);
  return z;
}

}  // namespace icwafer

/* SPDX-License-Identifier: Apache-2.0 */

/*
 * IC WAFER BSDF, model CS348B
 *
 * Diffraction by the parallel wires of an integrated circuit. The optics and their papers are in
 * kernel/icwafer/cs348b.h; this file only turns the closure's frame into theirs.
 */

#pragma once

#include "kernel/closure/bsdf_ic_wafer_frame.h"
#include "kernel/icwafer/cs348b_sample.h"

CCL_NAMESPACE_BEGIN

typedef struct IcWaferExtra {
  icwafer::Cs348bParams params;
} IcWaferExtra;

typedef struct IcWaferBsdf {
  SHADER_CLOSURE_BASE;

  /* Unit vector along the wires. */
  float3 T;
  /* Component of the view across the wires, and what the sampling density is divided by. */
  float view_u, total_power;
  ccl_private IcWaferExtra *extra;
} IcWaferBsdf;

static_assert(sizeof(ShaderClosure) >= sizeof(IcWaferBsdf), "IcWaferBsdf is too large!");
static_assert(sizeof(ShaderClosure) >= sizeof(IcWaferExtra), "IcWaferExtra is too large!");

ccl_device int bsdf_ic_wafer_setup(ccl_private IcWaferBsdf *bsdf, const float3 I)
{
  bsdf->type = CLOSURE_BSDF_IC_WAFER_ID;
  bsdf->view_u = clamp(dot(cross(bsdf->N, bsdf->T), I), -1.0f, 1.0f);
  bsdf->total_power = icwafer::cs348b_total_power(bsdf->extra->params, bsdf->view_u);

  /* Closures are picked by their weight: what is reflected, rather than what falls in. Light is
   * spread over the length pi / 2 of a mean chord of the unit disc, and half of it by the film. */
  const float film = (bsdf->extra->params.effects & icwafer::cs348b_thin_film) ? 0.5f : 1.0f;
  bsdf->sample_weight *= clamp(film * M_PI_2_F * bsdf->total_power, 0.05f, 1.0f);
  return SD_BSDF | SD_BSDF_HAS_EVAL;
}

ccl_device void bsdf_ic_wafer_blur(ccl_private ShaderClosure *sc, const float roughness)
{
  ccl_private IcWaferBsdf *bsdf = (ccl_private IcWaferBsdf *)sc;
  bsdf->extra->params.lobe_width = fmaxf(roughness, bsdf->extra->params.lobe_width);
  bsdf->total_power = icwafer::cs348b_total_power(bsdf->extra->params, bsdf->view_u);
}

ccl_device_inline float bsdf_ic_wafer_roughness(ccl_private const ShaderClosure *sc)
{
  return ((ccl_private const IcWaferBsdf *)sc)->extra->params.lobe_width;
}

/* Reflectance times cosine and the density of sampling, for directions in the local frame. */
ccl_device_inline Spectrum bsdf_ic_wafer_eval_local(KernelGlobals kg,
                                                    ccl_private const IcWaferBsdf *bsdf,
                                                    const icwafer::LocalDirection o,
                                                    const icwafer::LocalDirection i,
                                                    ccl_private float *pdf)
{
  *pdf = icwafer::cs348b_pdf(bsdf->extra->params, bsdf->total_power, o, i);
  const icwafer::Rgb f = icwafer::cs348b_eval(
      bsdf->extra->params, icwafer::grating_geometry(i, o), ic_wafer_tables(kg));
  return rgb_to_spectrum(make_float3(f.r, f.g, f.b) * i.n);
}

ccl_device Spectrum bsdf_ic_wafer_eval(KernelGlobals kg,
                                       ccl_private const ShaderClosure *sc,
                                       const float3 Ng,
                                       const float3 I,
                                       const float3 omega_in,
                                       ccl_private float *pdf)
{
  ccl_private const IcWaferBsdf *bsdf = (ccl_private const IcWaferBsdf *)sc;
  const icwafer::LocalDirection o = ic_wafer_local(bsdf->N, bsdf->T, I);
  const icwafer::LocalDirection i = ic_wafer_local(bsdf->N, bsdf->T, omega_in);
  if (!(o.n > 0.0f && i.n > 0.0f && dot(Ng, omega_in) > 0.0f)) {
    *pdf = 0.0f;
    return zero_spectrum();
  }
  return bsdf_ic_wafer_eval_local(kg, bsdf, o, i, pdf);
}

ccl_device int bsdf_ic_wafer_sample(KernelGlobals kg,
                                    ccl_private const ShaderClosure *sc,
                                    const float3 Ng,
                                    const float3 I,
                                    const float randu,
                                    const float randv,
                                    ccl_private Spectrum *eval,
                                    ccl_private float3 *omega_in,
                                    ccl_private float *pdf,
                                    ccl_private float2 *sampled_roughness)
{
  ccl_private const IcWaferBsdf *bsdf = (ccl_private const IcWaferBsdf *)sc;
  *sampled_roughness = make_float2(bsdf_ic_wafer_roughness(sc), 1.0f);
  *eval = zero_spectrum();
  *pdf = 0.0f;

  const icwafer::LocalDirection o = ic_wafer_local(bsdf->N, bsdf->T, I);
  const icwafer::LocalDirection i = icwafer::cs348b_sample(
      bsdf->extra->params, bsdf->total_power, o, randu, randv);
  *omega_in = ic_wafer_world(bsdf->N, bsdf->T, i);
  if (o.n > 0.0f && i.n > 0.0f && dot(Ng, *omega_in) > 0.0f) {
    *eval = bsdf_ic_wafer_eval_local(kg, bsdf, o, i, pdf);
  }
  return LABEL_REFLECT | LABEL_GLOSSY;
}

CCL_NAMESPACE_END

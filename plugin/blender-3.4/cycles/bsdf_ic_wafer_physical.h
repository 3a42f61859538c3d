/* SPDX-License-Identifier: Apache-2.0 */

/*
 * IC WAFER BSDF, model PHYSICAL
 *
 * Metal wires under oxide as a phase grating. The optics and their papers are in
 * kernel/icwafer/physical_model.h; this file only turns the closure's frame into theirs.
 */

#pragma once

#include "kernel/closure/bsdf_ic_wafer_frame.h"
#include "kernel/icwafer/physical_sample.h"

CCL_NAMESPACE_BEGIN

typedef struct IcWaferPhysicalExtra {
  icwafer::PhysicalParams params;
  icwafer::PhysicalView view;
} IcWaferPhysicalExtra;

typedef struct IcWaferPhysicalBsdf {
  SHADER_CLOSURE_BASE;

  /* Unit vector along the wires. */
  float3 T;
  ccl_private IcWaferPhysicalExtra *extra;
} IcWaferPhysicalBsdf;

static_assert(sizeof(ShaderClosure) >= sizeof(IcWaferPhysicalBsdf),
              "IcWaferPhysicalBsdf is too large!");

ccl_device int bsdf_ic_wafer_physical_setup(KernelGlobals kg,
                                            ccl_private IcWaferPhysicalBsdf *bsdf,
                                            const float3 I)
{
  bsdf->type = CLOSURE_BSDF_IC_WAFER_PHYSICAL_ID;
  bsdf->extra->view = icwafer::physical_view(
      bsdf->extra->params, ic_wafer_local(bsdf->N, bsdf->T, I), ic_wafer_tables(kg));
  /* Closures are picked by their weight: what is reflected, rather than what falls in. */
  bsdf->sample_weight *= saturatef(bsdf->extra->view.total_power);
  return SD_BSDF | SD_BSDF_HAS_EVAL;
}

ccl_device void bsdf_ic_wafer_physical_blur(ccl_private ShaderClosure *sc, const float roughness)
{
  ccl_private IcWaferPhysicalExtra *extra = ((ccl_private IcWaferPhysicalBsdf *)sc)->extra;
  extra->params.roughness = fmaxf(roughness, extra->params.roughness);
}

ccl_device_inline float2 bsdf_ic_wafer_physical_roughness(ccl_private const ShaderClosure *sc)
{
  ccl_private const icwafer::PhysicalParams *params =
      &((ccl_private const IcWaferPhysicalBsdf *)sc)->extra->params;
  return make_float2(sqrtf(icwafer::physical_lobe_variance(*params, params->across)),
                     sqrtf(icwafer::physical_lobe_variance(*params, params->along)));
}

/* Reflectance times cosine and the density of sampling, for directions in the local frame. */
ccl_device_inline Spectrum
bsdf_ic_wafer_physical_eval_local(KernelGlobals kg,
                                  ccl_private const IcWaferPhysicalExtra *extra,
                                  const icwafer::LocalDirection o,
                                  const icwafer::LocalDirection i,
                                  ccl_private float *pdf)
{
  *pdf = icwafer::physical_pdf(extra->params, extra->view, o, i);
  const icwafer::Rgb f = icwafer::physical_eval(extra->params, i, o, ic_wafer_tables(kg));
  return rgb_to_spectrum(make_float3(f.r, f.g, f.b) * i.n);
}

ccl_device Spectrum bsdf_ic_wafer_physical_eval(KernelGlobals kg,
                                                ccl_private const ShaderClosure *sc,
                                                const float3 Ng,
                                                const float3 I,
                                                const float3 omega_in,
                                                ccl_private float *pdf)
{
  ccl_private const IcWaferPhysicalBsdf *bsdf = (ccl_private const IcWaferPhysicalBsdf *)sc;
  const icwafer::LocalDirection o = ic_wafer_local(bsdf->N, bsdf->T, I);
  const icwafer::LocalDirection i = ic_wafer_local(bsdf->N, bsdf->T, omega_in);
  if (!(o.n > 0.0f && i.n > 0.0f && dot(Ng, omega_in) > 0.0f)) {
    *pdf = 0.0f;
    return zero_spectrum();
  }
  return bsdf_ic_wafer_physical_eval_local(kg, bsdf->extra, o, i, pdf);
}

ccl_device int bsdf_ic_wafer_physical_sample(KernelGlobals kg,
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
  ccl_private const IcWaferPhysicalBsdf *bsdf = (ccl_private const IcWaferPhysicalBsdf *)sc;
  *sampled_roughness = bsdf_ic_wafer_physical_roughness(sc);
  *eval = zero_spectrum();
  *pdf = 0.0f;

  const icwafer::LocalDirection o = ic_wafer_local(bsdf->N, bsdf->T, I);
  const icwafer::LocalDirection i = icwafer::physical_sample(
      bsdf->extra->params, bsdf->extra->view, o, randu, randv);
  *omega_in = ic_wafer_world(bsdf->N, bsdf->T, i);
  if (o.n > 0.0f && i.n > 0.0f && dot(Ng, *omega_in) > 0.0f) {
    *eval = bsdf_ic_wafer_physical_eval_local(kg, bsdf->extra, o, i, pdf);
  }
  return LABEL_REFLECT | LABEL_GLOSSY;
}

CCL_NAMESPACE_END

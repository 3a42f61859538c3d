/* SPDX-License-Identifier: Apache-2.0 */

/* What EEVEE shows of the IC Wafer BSDF: it has no diffraction, so the surface becomes a glossy
 * mirror with the tint of the oxide film at three wavelengths, over a little diffuse. */

void node_bsdf_ic_wafer(vec4 color,
                        float wire_spacing,
                        float wire_width,
                        float oxide_thickness,
                        float oxide_ior,
                        float direction,
                        float diffraction,
                        float specular,
                        float specular_roughness,
                        float diffuse,
                        float lobe_width,
                        float anisotropy,
                        float groove_depth,
                        float cross_spacing,
                        float cross_width,
                        float spacing_variation,
                        float coherence_width,
                        float wire_length,
                        float roughness,
                        vec3 metal_n,
                        vec3 metal_k,
                        vec3 N,
                        vec3 T,
                        float weight,
                        const float use_thin_film,
                        const vec3 metal_color,
                        out Closure result)
{
  N = safe_normalize(N);
  vec3 V = cameraVec(g_data.P);
  float NV = clamp(dot(N, V), 0.0, 1.0);

  vec3 film = vec3(1.0);
  if (use_thin_film != 0.0) {
    vec3 fringe = cos(2.0 * M_PI * oxide_ior * oxide_thickness * NV / vec3(610.0, 545.0, 450.0));
    film = fringe * fringe;
  }

  /* The CS348B model has no metal; the PHYSICAL one neither diffuse nor specular part. */
  bool physical = metal_color.g > 0.0;
  if (physical) {
    specular_roughness = roughness;
    diffuse = 0.0;
  }
  vec3 part = physical ? metal_color * (0.4 + 0.6 * film) : specular + diffraction * film;
  vec2 split_sum = brdf_lut(NV, specular_roughness);
  vec3 reflectance = clamp(color.rgb * part, vec3(0.0), vec3(1.0));

  ClosureReflection reflection_data;
  reflection_data.weight = weight;
  reflection_data.color = F_brdf_single_scatter(reflectance, reflectance, split_sum);
  reflection_data.N = N;
  reflection_data.roughness = clamp(specular_roughness, 0.0, 1.0);

  ClosureDiffuse diffuse_data;
  diffuse_data.weight = weight;
  diffuse_data.color = color.rgb * diffuse;
  diffuse_data.N = N;
  diffuse_data.sss_id = 0u;

  result = closure_eval(diffuse_data, reflection_data);
}

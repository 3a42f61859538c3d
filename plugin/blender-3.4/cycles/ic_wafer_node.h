/* SPDX-License-Identifier: Apache-2.0 */

/* The node IC Wafer BSDF in Cycles' scene, and its look-up table. */

#pragma once

#include "kernel/icwafer/illuminants.h"
#include "kernel/icwafer/metals.h"
#include "kernel/icwafer/node_inputs.h"
#include "kernel/icwafer/oxides.h"
#include "scene/shader_nodes.h"

CCL_NAMESPACE_BEGIN

enum ICWaferModel {
  IC_WAFER_CS348B = 0,
  IC_WAFER_PHYSICAL = 1,
};

class ICWaferBsdfNode : public BsdfNode {
 public:
  SHADER_NODE_CLASS(ICWaferBsdfNode)

#define ICWAFER_MEMBER(identifier, ...) NODE_SOCKET_API(float, identifier)
  ICWAFER_NODE_FLOATS(ICWAFER_MEMBER)
#undef ICWAFER_MEMBER
  NODE_SOCKET_API(float3, metal_n)
  NODE_SOCKET_API(float3, metal_k)
  NODE_SOCKET_API(float3, tangent)
  NODE_SOCKET_API(ICWaferModel, model)
  NODE_SOCKET_API(icwafer::Metal, metal)
  NODE_SOCKET_API(icwafer::Oxide, oxide)
  NODE_SOCKET_API(icwafer::Illuminant, illuminant)
  NODE_SOCKET_API(bool, use_wire_diffraction)
  NODE_SOCKET_API(bool, use_grating)
  NODE_SOCKET_API(bool, use_thin_film)

 private:
  void compile_cs348b(SVMCompiler &compiler);
  void compile_physical(SVMCompiler &compiler);
  void compile_closure(SVMCompiler &compiler,
                       ClosureType type,
                       uint inputs,
                       uint more_inputs,
                       int4 extra);
};

/* Whether any of the shaders has the node, and so needs the tables. */
bool has_ic_wafer(const vector<Shader *> &shaders);

/* icwafer::material_tables for the rows of the matrix from XYZ. */
vector<float> ic_wafer_tables(const float3 xyz_to_r, const float3 xyz_to_g, const float3 xyz_to_b);

CCL_NAMESPACE_END

/* SPDX-License-Identifier: GPL-2.0-or-later */

/* The node IC Wafer BSDF as Blender shows and saves it. Its float inputs come from one table
 * (shaders/icwafer/node_inputs.h); what it means optically is in Cycles' closure of that name. */

#include "node_shader_util.hh"

#include "UI_interface.h"
#include "UI_resources.h"

#include "ic_wafer_node_inputs.h"

namespace blender::nodes::node_shader_bsdf_ic_wafer_cc {

/* Bits of bNode.custom2, and what a new node has: all three effects. */
constexpr short all_effects = SHD_IC_WAFER_WIRE_DIFFRACTION | SHD_IC_WAFER_GRATING |
                              SHD_IC_WAFER_THIN_FILM;

constexpr PropertySubType NONE = PROP_NONE;
constexpr PropertySubType FACTOR = PROP_FACTOR;
constexpr PropertySubType ANGLE = PROP_ANGLE;

static void node_declare(NodeDeclarationBuilder &b)
{
  b.add_input<decl::Color>(N_("Color"))
      .default_value({1.0f, 1.0f, 1.0f, 1.0f})
      .description(N_("Tint of everything that is reflected, 0 to 1 per channel. White: the "
                      "colours of physics"));
#define ADD_INPUT(identifier, name, initial, least, most, kind, tooltip) \
  b.add_input<decl::Float>(N_(name)) \
      .default_value(initial) \
      .min(least) \
      .max(most) \
      .subtype(kind) \
      .description(N_(tooltip));
  ICWAFER_NODE_FLOATS(ADD_INPUT)
#undef ADD_INPUT
  b.add_input<decl::Vector>(N_("Normal"))
      .hide_value()
      .description(N_("Direction of the surface, a unit vector in world space; the geometry's "
                      "own where nothing is linked"));
  b.add_input<decl::Vector>(N_("Tangent"))
      .hide_value()
      .description(N_("Direction from which Direction is counted, a unit vector in world space; "
                      "the object's X axis where nothing is linked"));
  b.add_input<decl::Float>(N_("Weight")).unavailable();
  b.add_output<decl::Shader>(N_("BSDF"));
}

static void node_draw_buttons(uiLayout *layout, bContext * /*C*/, PointerRNA *ptr)
{
  uiItemR(layout, ptr, "model", UI_ITEM_R_SPLIT_EMPTY_NAME, "", ICON_NONE);
  uiLayout *column = uiLayoutColumn(layout, true);
  uiItemR(column, ptr, "use_grating", UI_ITEM_R_SPLIT_EMPTY_NAME, nullptr, ICON_NONE);
  uiItemR(column, ptr, "use_thin_film", UI_ITEM_R_SPLIT_EMPTY_NAME, nullptr, ICON_NONE);
  uiItemR(column, ptr, "use_wire_diffraction", UI_ITEM_R_SPLIT_EMPTY_NAME, nullptr, ICON_NONE);
}

static void node_init(bNodeTree * /*ntree*/, bNode *node)
{
  node->custom1 = SHD_IC_WAFER_CS348B;
  node->custom2 = all_effects;
}

static int node_gpu(GPUMaterial *mat,
                    bNode *node,
                    bNodeExecData * /*execdata*/,
                    GPUNodeStack *in,
                    GPUNodeStack *out)
{
  /* Position of `Normal`: after Color and the floats. */
#define COUNT_INPUT(...) +1
  constexpr int normal = 1 ICWAFER_NODE_FLOATS(COUNT_INPUT);
#undef COUNT_INPUT
  if (!in[normal].link) {
    GPU_link(mat, "world_normals_get", &in[normal].link);
  }
  GPU_material_flag_set(mat, GPU_MATFLAG_DIFFUSE | GPU_MATFLAG_GLOSSY);
  const float use_thin_film = (node->custom2 & SHD_IC_WAFER_THIN_FILM) ? 1.0f : 0.0f;
  return GPU_stack_link(mat, node, "node_bsdf_ic_wafer", in, out, GPU_constant(&use_thin_film));
}

}  // namespace blender::nodes::node_shader_bsdf_ic_wafer_cc

void register_node_type_sh_bsdf_ic_wafer()
{
  namespace file_ns = blender::nodes::node_shader_bsdf_ic_wafer_cc;

  static bNodeType ntype;

  sh_node_type_base(&ntype, SH_NODE_BSDF_IC_WAFER, "IC Wafer BSDF", NODE_CLASS_SHADER);
  ntype.declare = file_ns::node_declare;
  ntype.draw_buttons = file_ns::node_draw_buttons;
  /* Wide enough for the longest name of an input beside its value. */
  node_type_size(&ntype, 200, 150, 700);
  node_type_init(&ntype, file_ns::node_init);
  node_type_gpu(&ntype, file_ns::node_gpu);

  nodeRegisterType(&ntype);
}

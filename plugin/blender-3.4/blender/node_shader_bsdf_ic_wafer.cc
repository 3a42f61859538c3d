/* SPDX-License-Identifier: GPL-2.0-or-later */

/* The node IC Wafer BSDF as Blender shows and saves it. Its float inputs come from one table
 * (shaders/icwafer/node_inputs.h); what it means optically is in Cycles' closure of that name. */

#include "node_shader_util.hh"

#include "UI_interface.h"
#include "UI_resources.h"

#include "ic_wafer_node_inputs.h"

namespace blender::nodes::node_shader_bsdf_ic_wafer_cc {

/* What a new node has in bNode.custom2: all three effects, and the first of each list. */
constexpr short all_effects = SHD_IC_WAFER_WIRE_DIFFRACTION | SHD_IC_WAFER_GRATING |
                              SHD_IC_WAFER_THIN_FILM;

/* The table's models. */
enum { BOTH, PHYSICAL, CS348B };

constexpr PropertySubType NONE = PROP_NONE;
constexpr PropertySubType FACTOR = PROP_FACTOR;
constexpr PropertySubType ANGLE = PROP_ANGLE;

static void node_declare(NodeDeclarationBuilder &b)
{
  b.add_input<decl::Color>(N_("Color"))
      .default_value({1.0f, 1.0f, 1.0f, 1.0f})
      .description(N_("Tint of everything that is reflected, 0 to 1 per channel. White: the "
                      "colours of physics"));
#define ADD_INPUT(identifier, name, initial, least, most, kind, model, tooltip) \
  b.add_input<decl::Float>(N_(name)) \
      .default_value(initial) \
      .min(least) \
      .max(most) \
      .subtype(kind) \
      .description(N_(tooltip));
  ICWAFER_NODE_FLOATS(ADD_INPUT)
#undef ADD_INPUT
  b.add_input<decl::Vector>(N_("Metal n"))
      .default_value({0.27f, 0.68f, 1.3f})
      .min(0.02f)
      .max(10.0f)
      .description(N_("Index of refraction of the metal in red, green and blue light (612, 549, "
                      "464 nm), without unit. Gold: 0.2, 0.4, 1.4"));
  b.add_input<decl::Vector>(N_("Metal k"))
      .default_value({3.4f, 2.62f, 2.4f})
      .min(0.02f)
      .max(15.0f)
      .description(N_("Extinction of the metal in red, green and blue light (612, 549, 464 nm), "
                      "without unit. Larger is more mirror-like. Gold: 3.1, 2.4, 1.9"));
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
  if (RNA_enum_get(ptr, "model") == SHD_IC_WAFER_PHYSICAL) {
    uiItemR(layout, ptr, "metal", UI_ITEM_R_SPLIT_EMPTY_NAME, "", ICON_NONE);
    uiItemR(layout, ptr, "oxide", UI_ITEM_R_SPLIT_EMPTY_NAME, "", ICON_NONE);
    uiItemR(layout, ptr, "illuminant", UI_ITEM_R_SPLIT_EMPTY_NAME, "", ICON_NONE);
    return;
  }
  uiLayout *column = uiLayoutColumn(layout, true);
  uiItemR(column, ptr, "use_grating", UI_ITEM_R_SPLIT_EMPTY_NAME, nullptr, ICON_NONE);
  uiItemR(column, ptr, "use_thin_film", UI_ITEM_R_SPLIT_EMPTY_NAME, nullptr, ICON_NONE);
  uiItemR(column, ptr, "use_wire_diffraction", UI_ITEM_R_SPLIT_EMPTY_NAME, nullptr, ICON_NONE);
}

static void node_init(bNodeTree * /*ntree*/, bNode *node)
{
  node->custom1 = SHD_IC_WAFER_PHYSICAL;
  node->custom2 = all_effects;
}

/* Shows the inputs that the model has. */
static void node_update(bNodeTree *ntree, bNode *node)
{
  const bool physical = node->custom1 == SHD_IC_WAFER_PHYSICAL;
  const bool custom_metal = physical &&
                            (node->custom2 & SHD_IC_WAFER_METAL) == SHD_IC_WAFER_METAL_CUSTOM;
  const bool custom_oxide = !physical ||
                            (node->custom2 & SHD_IC_WAFER_OXIDE) == SHD_IC_WAFER_OXIDE_CUSTOM;
  const auto show = [&](const char *name, const bool available) {
    bNodeSocket *socket = nodeFindSocket(node, SOCK_IN, name);
    nodeSetSocketAvailability(ntree, socket, available);
  };
#define SHOW_INPUT(identifier, name, initial, least, most, kind, model, tooltip) \
  show(name, model == BOTH || (model == PHYSICAL) == physical);
  ICWAFER_NODE_FLOATS(SHOW_INPUT)
#undef SHOW_INPUT
  show("Oxide IOR", custom_oxide);
  show("Metal n", custom_metal);
  show("Metal k", custom_metal);
}

static int node_gpu(GPUMaterial *mat,
                    bNode *node,
                    bNodeExecData * /*execdata*/,
                    GPUNodeStack *in,
                    GPUNodeStack *out)
{
  /* Position of `Normal`: after Color, the floats and the metal's two. */
#define COUNT_INPUT(...) +1
  constexpr int normal = 3 ICWAFER_NODE_FLOATS(COUNT_INPUT);
#undef COUNT_INPUT
  if (!in[normal].link) {
    GPU_link(mat, "world_normals_get", &in[normal].link);
  }
  GPU_material_flag_set(mat, GPU_MATFLAG_DIFFUSE | GPU_MATFLAG_GLOSSY);
  const bool physical = node->custom1 == SHD_IC_WAFER_PHYSICAL;
  const float use_thin_film = (physical || (node->custom2 & SHD_IC_WAFER_THIN_FILM)) ? 1.0f : 0.0f;
  /* Reflectance under oxide in red, green and blue light; the last is taken for a metal of the
   * artist's own. Black: the model without a metal. */
  static const float metal_colors[][3] = {{0.93f, 0.55f, 0.46f},
                                          {0.86f, 0.87f, 0.89f},
                                          {0.40f, 0.37f, 0.35f},
                                          {0.20f, 0.22f, 0.27f},
                                          {0.80f, 0.80f, 0.80f}};
  static const float no_metal[3] = {0.0f, 0.0f, 0.0f};
  const float *metal_color =
      physical ? metal_colors[(node->custom2 & SHD_IC_WAFER_METAL) >> SHD_IC_WAFER_METAL_SHIFT] :
                 no_metal;
  return GPU_stack_link(mat,
                        node,
                        "node_bsdf_ic_wafer",
                        in,
                        out,
                        GPU_constant(&use_thin_film),
                        GPU_constant(metal_color));
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
  node_type_update(&ntype, file_ns::node_update);
  node_type_gpu(&ntype, file_ns::node_gpu);

  nodeRegisterType(&ntype);
}

#include "solidnoise/volume/sky/sky_scene.h"

#include <cstddef>

#include <fmt/format.h>

#include "solidnoise/geometry/scene_values.h"

namespace solidnoise {

std::string sky_scene_text(const SkyPlan& plan, const std::string& name,
                           const std::vector<std::string>& scenes) {
  const bool z_up = plan.recipe.cloud.up == UpAxis::z;
  const std::string prim = usd_name(name);
  std::string text = fmt::format(
      "#usda 1.0\n(\n    defaultPrim = \"{}\"\n    metersPerUnit = 1\n    upAxis = \"{}\"\n)\n\ndef Xform "
      "\"{}\"\n{{\n",
      prim, z_up ? "Z" : "Y", prim);
  // What programs that have instances hold once: a prim of each cloud, which is not seen itself.
  text += "    class \"clouds\"\n    {\n";
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    const char* const mark = scenes[i].find('@') == std::string::npos ? "@" : "@@@";
    text += fmt::format(
        "        class Xform \"{}\"\n        {{\n            def \"volume\" (\n                prepend "
        "references "
        "= {}./{}{}\n            )\n            {{\n            }}\n        }}\n\n",
        plan.clouds[i].name, mark, scenes[i], mark);
  }
  text += "    }\n";
  const char* const turn = z_up ? "rotateZ" : "rotateY";
  for (std::size_t i = 0; i < plan.instances.size(); ++i) {
    const SkyInstance& instance = plan.instances[i];
    const SkyPoint& p = instance.point;
    text += fmt::format(
        "\n    def Xform \"point_{:05}\" (\n        instanceable = true\n        prepend references = "
        "</{}/clouds/{}>\n    )\n    {{\n        double3 xformOp:translate = ({}, {}, {})\n        double "
        "xformOp:{} = {}\n        double3 xformOp:scale = ({}, {}, {})\n        uniform token[] xformOpOrder "
        "= "
        "[\"xformOp:translate\", \"xformOp:{}\", \"xformOp:scale\"]\n    }}\n",
        i, prim, plan.clouds[instance.cloud].name, p.x, p.y, p.z, turn, p.turn, instance.scale,
        instance.scale, instance.scale, turn);
  }
  return text + "}\n";
}

}  // namespace solidnoise

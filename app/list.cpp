#include "app/list.h"

#include <iostream>

#include "app/options.h"
#include "softbody/integrators.h"

namespace app {

void list(const std::string& what) {
  const auto row = [](std::string_view key, std::string_view name) { std::cout << key << '\t' << name << '\n'; };
  if (what == "methods") {
    for (const collide::Method& m : collide::methods()) row(m.key, m.name);
  } else if (what == "integrators") {
    for (const softbody::Integrator& i : softbody::integrators()) row(i.key, i.name);
  } else {
    const auto folder = scene_folder();
    for (const std::string& key : softbody::scene_keys(folder)) row(key, softbody::find_scene(key, folder).name);
  }
}

}  // namespace app

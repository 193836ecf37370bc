#include "app/cli/commands.h"

#include <iostream>
#include <optional>

#include "app/files/inputs.h"
#include "collide/methods.h"
#include "softbody/integrate/integrators.h"
#include "softbody/scene/scene.h"

namespace app::cli {
namespace {

void row(std::string_view key, std::string_view name) { std::cout << key << '\t' << name << '\n'; }

/// Lists all valid scenes, then throws the error of the first invalid one.
void list_scenes(const std::filesystem::path& folder) {
  std::optional<softbody::SceneError> first_error;
  for (const std::string& key : softbody::scene_keys(folder)) {
    try {
      row(key, softbody::find_scene(key, folder).name);
    } catch (const softbody::SceneError& error) {
      if (!first_error) first_error = error;
    }
  }
  if (first_error) throw *first_error;
}

}  // namespace

void list(const std::string& what) {
  const auto wants = [&](std::string_view name) {
    if (what.empty()) std::cout << name << '\n';
    return what.empty() || what == name;
  };
  if (wants("methods"))
    for (const collide::Method& m : collide::method_table()) row(m.key, m.name);
  if (wants("integrators"))
    for (const softbody::Integrator& i : softbody::integrators()) row(i.key, i.name);
  if (wants("contact-surfaces"))
    for (const softbody::ContactSurfaceInfo& s : softbody::contact_surfaces) row(s.key, s.name);
  if (wants("scenes")) list_scenes(files::scene_folder());
}

}  // namespace app::cli

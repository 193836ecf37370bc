#include "tests/soak/actions.h"

#include <array>
#include <fstream>

#include "collide/methods.h"
#include "softbody/contact/keys.h"
#include "softbody/forces/gas.h"
#include "softbody/forces/springs.h"
#include "softbody/integrate/integrators.h"

namespace soak {
namespace {

using app::Session;

void method(DemoRig& demo, Dice& dice) {
  demo.session.settings.set_method(collide::method_table()[dice.pick(collide::method_table().size())].key);
}

/// The substeps may be far too few: then the bodies explode, and the demo must say so. Implicit substeps are fewer, as
/// each is a solve.
void integrator(DemoRig& demo, Dice& dice) {
  const auto all = softbody::integrators();
  const softbody::Integrator& one = all[dice.pick(all.size())];
  const int substeps = 1 << dice.pick(one.implicit ? 3 : 6);
  demo.session.settings.set_integrator({std::string(one.key), dice.heads() ? std::nullopt : std::optional(substeps)});
}

/// Returns an end of the range every other time, else a value in between.
template <class T>
T end_or_between(Dice& dice, T min, T max) {
  const std::size_t which = dice.pick(4);
  if (which == 0) return min;
  return which == 1 ? max : static_cast<T>(dice.between(double(min), double(max)));
}

void detection(DemoRig& demo, Dice& dice) {
  collide::Settings s = demo.session.world().collision();
  if (dice.heads()) s.cell_size.reset();
  switch (dice.pick(5)) {
    case 0:
      s.levels = end_or_between(dice, 0, collide::max_levels);
      break;
    case 1:
      s.buckets = end_or_between(dice, 1u, collide::max_buckets);
      break;
    case 2:
      s.cell_size = glm::vec3(float(end_or_between(dice, 1e-3, 1e3)));
      break;
    case 3:
      s.tolerance = float(end_or_between(dice, 0.0, 0.3));
      break;
    default:
      s.self_collision = !s.self_collision;
  }
  demo.session.simulation.change_scene("Settings", [&](softbody::Scene& scene) { scene.collision = s; });
}

void drop(DemoRig& demo, Dice& dice) {
  demo.session.bodies.drop(dice.heads() ? 1 : app::session::BodyControls::many_drops);
}

void throw_body(DemoRig& demo, Dice& dice) {
  demo.session.bodies.throw_speed =
      end_or_between(dice, app::session::BodyControls::min_throw_speed, app::session::BodyControls::max_throw_speed);
  const engine::Ray ray = demo.centre_ray();
  demo.session.bodies.throw_body(glm::dvec3(ray.origin), glm::dvec3(ray.direction));
}

void remove(DemoRig& demo, Dice& dice) {
  const auto count = demo.session.world().bodies().count();
  if (count > 0) demo.session.bodies.select(static_cast<softbody::BodyId>(dice.pick(count)));
  demo.session.bodies.remove_selected();
}

/// Anywhere: on a body, on the background, on the panel.
void mouse(DemoRig& demo, Dice& dice) {
  const glm::vec2 size(demo.input.display_size);
  demo.input.mouse = {float(dice.between(0, size.x)), float(dice.between(0, size.y))};
  demo.input.buttons = {dice.heads(), dice.pick(8) == 0, false};
  demo.input.wheel = float(dice.between(-2, 2));
}

void gravity(DemoRig& demo, Dice& dice) {
  demo.session.simulation.change_scene("Gravity", [&](softbody::Scene& s) {
    s.gravity = {0, -end_or_between(dice, 0.0, 30.0), 0};
  });
}

void material(DemoRig& demo, Dice& dice) {
  const auto& all = demo.session.world().scene().materials;
  if (all.empty()) return;
  const std::size_t index = dice.pick(all.size());
  softbody::Material m = all[index];
  switch (dice.pick(5)) {
    case 0:
      m[softbody::Material::mass] = end_or_between(dice, 0.01, 100.0);
      break;
    case 1:
      m[softbody::StructuralSprings::stiffness] = end_or_between(dice, 0.0, 1e6);
      break;
    case 2:
      m[softbody::StructuralSprings::damping_ratio] = end_or_between(dice, 0.0, 2.0);
      break;
    case 3:
      m[softbody::GasPressure::inside] = end_or_between(dice, 0.0, 2e5);
      break;
    default:
      m[softbody::contact::friction] = end_or_between(dice, 0.0, 2.0);
  }
  demo.session.simulation.change_scene("Material", [&](softbody::Scene& s) { s.materials[index] = m; });
}

void solids(DemoRig& demo, Dice& dice) {
  const std::vector<softbody::Solid>& list = demo.session.world().scene().solids;
  if (list.empty()) return;
  const std::size_t index = dice.pick(list.size());
  softbody::Solid solid = list[index];
  solid.enabled = !solid.enabled;
  demo.session.settings.set_solid(index, solid);
}

/// Any scene but the large one, of which one frame takes as long as a second of the others.
void scene(DemoRig& demo, Dice& dice) {
  std::vector<app::session::SceneChoice> small = demo.session.scenes.choices();
  std::erase_if(small, [](const app::session::SceneChoice& choice) { return choice.key == "drop-3000"; });
  demo.session.scenes.choose(small[dice.pick(small.size())].key);
}

void restore_settings(DemoRig& demo, Dice&) {
  demo.session.settings.restore_detection();
  demo.session.settings.restore_world();
}

void rewind(DemoRig& demo, Dice& dice) {
  const auto& past = demo.session.simulation.stability().past().snapshots();
  if (past.empty()) return;
  demo.session.simulation.rewind_to(past[dice.pick(past.size())].frame);
  demo.session.simulation.clock.paused = false;
}

/// Imports a tetrahedron of any size; every other file is broken.
void import_mesh(DemoRig& demo, Dice& dice) {
  constexpr std::array faces{"f 1 2 3\nf 1 4 2\nf 2 4 3\nf 3 4 1\n", "f 1 2 9\n", "f 1 2 3\nf 1 2 4\nf 1 2 4\n",
                             "f 1 2\n", "f 1 2 3\nv nan 0 0\n"};
  const std::string file = demo.session.exporter.folder + "/mesh.obj";
  std::ofstream(file) << "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n"
                      << faces[dice.heads() ? 0 : 1 + dice.pick(faces.size() - 1)];
  demo.session.import.size = float(dice.between(0.2, 1));
  demo.session.import.drop({file});
}

void resize(DemoRig& demo, Dice& dice) { demo.resize({end_or_between(dice, 1, 900), end_or_between(dice, 1, 700)}); }

void view(DemoRig& demo, Dice& dice) {
  for (const app::render::OverlayRow& row : app::render::overlay_table) demo.ui.overlays.*row.shown = dice.pick(4) == 0;
  demo.ui.panel = dice.heads();
  demo.ui.hash_table = dice.heads();
  demo.ui.help = dice.pick(8) == 0;
  demo.ui.lower = static_cast<app::ui::LowerView>(dice.pick(3));
  demo.ui.lights = dice.heads();
  demo.ui.story = dice.heads();
  demo.ui.clean = dice.pick(8) == 0;
  demo.session.inspector.select_bucket(dice.pick(1001));
  demo.restart_camera();
}

constexpr std::array table{
    Action{"method", method},
    Action{"contact surface", [](DemoRig& demo, Dice&) { demo.session.settings.next_contact_surface(); }},
    Action{"integrator", integrator},
    Action{"automatic integrator", [](DemoRig& demo, Dice&) { demo.session.settings.set_integrator({}); }},
    Action{"detection", detection},
    Action{"drop", drop},
    Action{"throw", throw_body},
    Action{"remove", remove},
    Action{"mouse", mouse},
    Action{"gravity", gravity},
    Action{"material", material},
    Action{"solids", solids},
    Action{"scene", scene},
    Action{"reset", [](DemoRig& demo, Dice&) { demo.session.simulation.reset(); }},
    Action{"undo", [](DemoRig& demo, Dice&) { undo(demo.session.simulation); }},
    Action{"redo", [](DemoRig& demo, Dice&) { redo(demo.session.simulation); }},
    Action{"as the scene has it", restore_settings},
    Action{"rewind", rewind},
    Action{"save", [](DemoRig& demo, Dice&) { demo.session.scenes.save(demo.ui.save_as, demo.ui.view); }},
    Action{"picture", [](DemoRig& demo, Dice&) { demo.session.exporter.picture_requested = true; }},
    Action{"curves", [](DemoRig& demo, Dice&) { demo.session.exporter.write_curves(); }},
    Action{"import", import_mesh},
    Action{"resize", resize},
    Action{"view", view}};

}  // namespace

std::span<const Action> actions() { return table; }

}  // namespace soak

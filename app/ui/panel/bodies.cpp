// The panel's section on bodies: how they are dropped and thrown, and the selected one.

#include <fmt/core.h>
#include <glm/geometric.hpp>

#include "app/render/palette.h"
#include "app/ui/panel/panel.h"
#include "collide/core/vertex_run.h"
#include "softbody/model/body_model.h"
#include "softbody/world/measures.h"

namespace app::ui {
namespace {

void draw_drop_and_throw(Widgets& w, const Session& session) {
  if (!session.simulated()) return;
  w.row_label("Throw", w.px(label_column));
  double speed = session.bodies.throw_speed;
  if (w.slider("Throw speed", speed, session::BodyControls::min_throw_speed, session::BodyControls::max_throw_speed,
               "%.0f m/s", "How fast bodies are thrown.", true))
    w.ask([speed](Session& s) { s.bodies.throw_speed = speed; });
  if (w.button("Drop 20", "Drops twenty bodies side by side (Shift+D).", -FLT_MIN, session.bodies.can_drop()))
    w.ask([](Session& s) { s.bodies.drop(session::BodyControls::many_drops); });
}

const char* state_text(const softbody::World& world, softbody::BodyId id) {
  if (const auto& grab = world.grabbed(); grab && grab->body == id) return "in your hand";
  if (world.body(id).pinned) return "held in place";
  return world.body(id).asleep ? "asleep" : "awake";
}

/// Returns the volume of a body over that of its mesh, in words.
std::string volume_text(const softbody::BodiesInMotion& world, softbody::BodyId id) {
  const softbody::BodyModel& model = world.model(id);
  if (!model.mesh.closed) return "open";
  const collide::VertexRun at = collide::vertices_of(world.simulated().positions, id);
  std::vector<glm::dvec3> vertices;
  for (collide::Index v = 0; v < at.size; ++v) vertices.emplace_back(at[v]);
  return fmt::format("{:.1f} %", 100 * softbody::volume(vertices, model.mesh.triangles) / model.start_volume);
}

void draw_selected(Widgets& w, const Session& session, softbody::BodyId id) {
  const softbody::BodiesInMotion& world = session.world();
  const softbody::World* simulated = session.simulated();
  w.swatch(render::body_colour(world.body(id).number));
  ImGui::Text("Body %u: %s vertices", id, grouped(world.bodies().size(id)).c_str());
  ImGui::SameLine();
  w.right_text(simulated ? state_text(*simulated, id) : "recorded");
  const std::size_t particles = world.model(id).mesh.vertices.size();
  w.register_item("Selected body",
                  fmt::format("The body that was clicked last, simulated by {} particles. Bodies and vertices count "
                              "from 0.",
                              grouped(particles)));
  const std::string volume = volume_text(world, id);
  if (!simulated) return w.figure("Volume", volume, "Of the volume in the first frame with this body.");
  const double speed =
      glm::length(softbody::measure(*simulated, id).momentum) / world.model(id).material[softbody::Material::mass];
  w.figure("Speed, volume", fmt::format("{:.2f} m/s   {}", speed, volume),
           "Of its centre of mass; of the volume that it started with.");
}

void draw_no_selection(Widgets& w, bool can_pull) {
  ImGui::TextDisabled("No body selected: click one in the scene.");
  w.register_item("Selected body", can_pull ? "Drag a body to pull it; double-click it to look at it."
                                            : "Double-click a body to look at it.");
  ImGui::TextDisabled(can_pull ? "Drag one to pull it." : "Double-click one to look at it.");
}

}  // namespace

void draw_bodies(Widgets& w, const Session& session, const UiState&) {
  draw_drop_and_throw(w, session);
  const bool has_solver = session.simulated();
  const auto& body = session.bodies.selected();
  if (body)
    draw_selected(w, session, *body);
  else
    draw_no_selection(w, has_solver);
  const float width = 0.5f * (ImGui::GetContentRegionAvail().x - ImGui::GetStyle().ItemSpacing.x);
  const Disabled off(!body);
  if (w.button("Look at it", "The camera goes to the selected body, as a double-click on it does.", width))
    w.ask(WindowTask::show_selected_body);
  if (has_solver) ImGui::SameLine();
  if (has_solver && w.button("Delete", "Takes the selected body out of the world (Del); Ctrl+Z brings it back.", width))
    w.ask([](Session& s) { s.bodies.remove_selected(); });
}

}  // namespace app::ui

#include "app/ui/views/surface_view.h"

#include <fmt/core.h>

#include "app/render/palette.h"

namespace app::ui {
namespace {

std::string millimetres(double metres) { return fmt::format("{:.2f} mm", metres * 1e3); }

std::string vertices_and_edges(std::size_t vertices, std::size_t edge_pairs) {
  return grouped(vertices) + " + " + grouped(edge_pairs);
}

std::string share(std::size_t part, std::size_t whole) { return grouped(part) + " of " + grouped(whole); }

void draw_state(Widgets& w, const Session& session) {
  const compare::SurfaceReport& report = session.surfaces.report();
  std::string text = "True surfaces: ";
  if (!report.failure.empty())
    text.append("not judged, ").append(report.failure);
  else if (report.id == 0)
    text += "judging";
  else
    text += report.id == session.simulation.revision() ? "as shown" : "frame " + std::to_string(report.frame);
  w.text_line(text);
  w.register_item(
      "Judged frame",
      "The state that these figures are of, judged exactly on a copy beside the simulation: that of an earlier "
      "frame while bodies move. Solids are not judged.");
}

void draw_overlaps(Widgets& w, const collide::oracle::SurfaceFigures& figures) {
  w.figure("Penetrating vertices", grouped(figures.penetrating_vertices), "Vertices inside another closed body.");
  w.figure("Overlapping pairs", grouped(figures.overlapping_pairs),
           "Pairs of bodies of which one has a vertex in the other, or an edge through a face of it.");
  w.figure("Through themselves", grouped(figures.self_intersecting_bodies),
           "Bodies with an edge through a face of their own.");
  w.figure("Deepest", millimetres(figures.deepest), "Largest distance of a penetrating vertex to the surface.");
  w.figure("Mean depth", millimetres(figures.mean_depth), "Over all penetrating vertices.");
}

void draw_crossings(Widgets& w, const collide::oracle::SurfaceFigures& figures, const session::CrossingSums& sums) {
  w.figure("Passed in this step", vertices_and_edges(figures.crossed_vertices, figures.edge_crossings),
           "Vertices that passed through a face in the step to this frame, either way, and pairs of edges that passed "
           "through each other: on straight lines from the frame before.");
  w.figure("Passed in judged steps", vertices_and_edges(sums.vertices, sums.edge_pairs),
           "The same, summed over all steps judged since this was switched on or the scene reset.");
  w.figure(
      "Judged steps", grouped(static_cast<std::uint64_t>(sums.steps)),
      "How many these are. Where bodies are many or the machine is slow, steps in between are not judged: pause and "
      "step (N) to see each.");
}

void draw_missed(Widgets& w, const Session& session) {
  const compare::SurfaceReport& report = session.surfaces.report();
  w.swatch(render::contact_missed_colour, ImGui::GetTextLineHeight());
  ImGui::SameLine();
  w.text_line("Missed surface contacts");
  w.register_item(
      "Missed surface contacts",
      "Overlaps that the method's contacts between vertices (§2.3) do not show. The scene hatches the surface round "
      "penetrating vertices and piercing edges. A line joins the deepest vertex of two bodies to the nearest point of "
      "the surface that it passed.");
  w.figure(
      "  vertices", share(report.missed_penetrations, report.penetrations),
      "Penetrating vertices without a contact with any vertex of the body they are in. One inside two bodies counts "
      "twice.");
  w.figure("  edges", share(report.missed_piercings, report.figures.piercings),
           "Edges through a face without a contact between an end of the one and a corner of the other.");
  const std::size_t pairs = report.figures.overlapping_pairs + report.figures.self_intersecting_bodies;
  w.figure("  pairs", share(report.missed_pairs, pairs),
           "Overlapping bodies, also with themselves, without any contact at all.");
}

}  // namespace

void draw_true_surfaces(Widgets& w, const Session& session) {
  draw_state(w, session);
  draw_overlaps(w, session.surfaces.report().figures);
  draw_missed(w, session);
  if (w.section("Passages", false)) draw_crossings(w, session.surfaces.report().figures, session.surfaces.sums());
}

}  // namespace app::ui

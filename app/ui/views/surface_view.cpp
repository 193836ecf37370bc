#include "app/ui/views/views.h"

#include <algorithm>

#include <fmt/core.h>

#include "app/render/palette.h"
#include "softbody/model/body_model.h"

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
    text.append("not checked, ").append(report.failure);
  else if (report.id == 0)
    text += "checking";
  else
    text += report.id == session.simulation.revision() ? "this frame" : "frame " + std::to_string(report.frame);
  w.text_line(text);
  w.register_item("Checked frame",
                  "The frame that was checked. While bodies move, it is an earlier one. Solids are not checked.");
}

/// Draws how far what is seen is from what is checked.
void draw_distance(Widgets& w, const softbody::BodiesInMotion& world) {
  double distance = 0;
  for (softbody::BodyId id = 0; id < world.bodies().count(); ++id)
    if (const auto& fine = world.model(id).fine) distance = std::max(distance, fine->imported->coarse->distance);
  if (distance > 0)
    w.figure("Fine meshes within", millimetres(distance),
             "The surfaces of the simulated meshes are checked. At rest, the fine meshes that are drawn are no farther "
             "from them than this.");
}

void draw_overlaps(Widgets& w, const collide::oracle::SurfaceFigures& figures) {
  w.figure("Penetrating vertices", grouped(figures.penetrating_vertices), "Vertices inside another closed body.");
  w.figure("Overlapping pairs", grouped(figures.overlapping_pairs),
           "Pairs of bodies with a vertex of one inside the other, or an edge of one through a face of the other.");
  w.figure("Self-penetrating bodies", grouped(figures.self_intersecting_bodies),
           "Bodies with an edge through one of their own faces.");
  w.figure("Largest depth", millimetres(figures.deepest), "Largest distance of a penetrating vertex to the surface.");
  w.figure("Mean depth", millimetres(figures.mean_depth), "Mean distance of all penetrating vertices to the surface.");
}

void draw_crossings(Widgets& w, const collide::oracle::SurfaceFigures& figures, const session::CrossingSums& sums) {
  w.figure(
      "Passed in this step", vertices_and_edges(figures.crossed_vertices, figures.edge_crossings),
      "Vertices that passed through a face in the last step, and pairs of edges that passed through each other: they "
      "met, and the side changed.");
  w.figure("Passed in all checked steps", vertices_and_edges(sums.vertices, sums.edge_pairs),
           "The same, summed over all checked steps.");
  w.figure("Checked steps", grouped(static_cast<std::uint64_t>(sums.steps)),
           "Number of checked steps. In large scenes some steps are left out: step by hand (N) to check each.");
}

void draw_missed(Widgets& w, const Session& session) {
  const compare::SurfaceReport& report = session.surfaces.report();
  w.swatch(render::contact_missed_colour);
  w.text_line("Missed surface contacts");
  w.register_item("Missed surface contacts",
                  "Overlaps of surfaces without a contact between vertices (§2.3). The scene hatches the surface round "
                  "them. A line joins the deepest vertex of two bodies to the nearest point of the surface.");
  w.figure("  vertices", share(report.missed_penetrations, report.penetrations),
           "Penetrating vertices without a contact with the body that they are in.");
  w.figure("  edges", share(report.missed_piercings, report.figures.piercings),
           "Edges through a face without a contact between their vertices.");
  const std::size_t pairs = report.figures.overlapping_pairs + report.figures.self_intersecting_bodies;
  w.figure("  pairs", share(report.missed_pairs, pairs), "Overlapping pairs of bodies without any contact.");
}

}  // namespace

void draw_true_surfaces(Widgets& w, const Session& session) {
  draw_state(w, session);
  draw_distance(w, session.world());
  draw_overlaps(w, session.surfaces.report().figures);
  draw_missed(w, session);
  if (w.section("Passages")) draw_crossings(w, session.surfaces.report().figures, session.surfaces.sums());
}

}  // namespace app::ui

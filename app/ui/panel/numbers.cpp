// The panel's section on counters and timings.

#include <algorithm>
#include <array>

#include <fmt/core.h>

#include "app/render/palette.h"
#include "app/ui/panel/panel.h"
#include "app/ui/views/views.h"
#include "softbody/world/measures.h"

namespace app::ui {
namespace {

constexpr std::array<const char*, collide::skip_kinds.size()> skip_tooltips{
    "Pairs of bodies with boxes that are far apart (§2.1).",
    "Pairs of bodies with near boxes, but with a plane or two spheres between them.",
    "Bodies without another body near them.", "Bodies that are too little deformed to touch themselves (§2.4).",
    "Pairs of bodies that have not moved since the last frame. Their contacts are kept."};
// A value above this waits for a change: the scene's picture is drawn only then.
constexpr double longest_pace = 0.1;     // s
constexpr std::size_t rate_median = 15;  // pictures

constexpr glm::vec3 detect_colour{0.835f, 0.369f, 0.000f}, solve_colour{0.000f, 0.447f, 0.698f};

/// Draws how many pictures come per second, or why none do.
void draw_picture_rate(Widgets& w, const Session& session, const UiState& ui) {
  const TimeSeries& times = session.simulation.history.frame_ms;
  if (ui.picture_interval > 0) {
    const std::string text = ui.picture_interval > longest_pace
                                 ? "still: drawn when something changes"
                                 : fmt::format("still: {:.0f} per second", 1 / ui.picture_interval);
    return w.figure("Pictures", text, "The program saves power: it draws fewer pictures while nothing moves.");
  }
  const float ms = times.median(rate_median);
  w.curve("Pictures", ms > 0 ? fmt::format("{:.0f}/s, {:.1f} ms", 1e3f / ms, ms) : "-", times,
          {0, axis_end(times.max(), 20.0f)}, glm::vec3(0.45f),
          {"Pictures per second, and the time from one to the next.", "ms"});
}

void draw_curves(Widgets& w, const Session& session, const UiState& ui) {
  const session::StepHistory& history = session.simulation.history;
  const softbody::StepReport& report = session.world().last_step();
  const float ms = axis_end(std::max(history.detect_ms.max(), history.solve_ms.max()), 1.0f);
  w.curve("Detect", fmt::format("{:.2f} ms", report.detect_ms), history.detect_ms, {0, ms}, detect_colour,
          {"Time to find the contacts of the latest frame: measured once, as the program runs, with kept contacts and "
           "cold caches. The comparison repeats searches from scratch on one core, which takes less or more.",
           "ms"});
  if (session.simulated())
    w.curve("Solve", fmt::format("{:.2f} ms", report.solve_ms), history.solve_ms, {0, ms}, solve_colour,
            {"Time to move the bodies by a frame.", "ms"});
  draw_picture_rate(w, session, ui);
}

/// Draws the recall, then the contacts with their parts.
void draw_contacts(Widgets& w, const Session& session) {
  const collide::Result& found = session.world().detection();
  const session::StepHistory& history = session.simulation.history;
  const compare::CompareRow* driver = session.comparison.driver_row();
  const std::string value = driver ? fmt::format("{:.4f}", rounded_down(driver->recall)) : "-";
  w.curve("Recall", value, session.comparison.recall(), {0, 1}, glm::vec3(0.45f),
          {"Share of the true contacts that the method found.", ""});
  w.curve("Contacts found", grouped(found.contacts.size()), history.contacts,
          {0, axis_end(history.contacts.max(), 10.0f)}, glm::vec3(0.45f),
          {"Pairs of vertices closer than the tolerance that the method found (§2.3).", "contacts"});
  w.figure("  between bodies", grouped(found.contacts.size() - found.self_contacts),
           "Contacts between vertices of two bodies (§2.3).");
  w.figure("  inside one body", grouped(found.self_contacts), "Contacts between vertices of one body (§2.4).");
  if (const softbody::World* world = session.simulated())
    w.figure("Contacts with solids", grouped(softbody::solid_contacts(*world).size()),
             "Vertices that touch a solid or the ground. The method does not search for these.");
}

void draw_surface_contacts(Widgets& w, const Session& session) {
  if (session.world().scene().contact_surface != softbody::ContactSurface::surfaces) return;
  const auto& contacts = session.inspector.surface_contacts();
  const auto inside = static_cast<std::size_t>(std::ranges::count_if(
      contacts, [](const softbody::SurfaceContactPoint& contact) { return contact.a == contact.b; }));
  w.figure("Surface contacts", grouped(contacts.size()),
           "Contacts of vertices with faces and of edges with edges in the last substep, without bodies that sleep.");
  w.figure("  surfaces of two bodies", grouped(contacts.size() - inside), "Surface contacts between two bodies.");
  w.figure("  surface of one body", grouped(inside), "Surface contacts inside one body.");
}

/// Draws the work that the exact method has skipped, a line for each kind even if there is none, so that nothing moves.
void draw_skipped(Widgets& w, const Session& session) {
  const collide::Method& method = session.world().method();
  if (method.key != collide::default_method) return;
  ImGui::TextDisabled("Work skipped");
  w.register_item("Skipped", "Work that this frame did not need. A proof shows that no contact is lost.");
  for (std::size_t kind = 0; kind < collide::skip_kinds.size(); ++kind) {
    const std::string label = "  " + std::string(collide::skip_kinds[kind].text);
    w.figure(label, grouped(session.world().detection().skipped[kind]), skip_tooltips[kind]);
  }
}

/// Draws the pair tests beside the claims of §3.
void draw_pair_tests(Widgets& w, const Session& session) {
  const collide::Counters& counters = session.world().detection().counters;
  const std::uint64_t vertices = session.world().bodies().vertex_count();
  const std::uint64_t all =
      compare::all_pair_tests(session.world().bodies(), session.world().collision().self_collision);
  w.figure("Pair tests", grouped(counters.pair_tests),
           "Distances between vertices that were evaluated in this frame (§2.3).");
  w.figure("  for each vertex", ratio(counters.pair_tests, vertices),
           fmt::format("Pair tests over vertices ({}). §3 claims a constant number at best.", grouped(vertices)));
  w.figure("  of all pairs", ratio(100 * counters.pair_tests, all) + " %",
           fmt::format("Share of all {} pairs that was tested. §3 claims all pairs at worst.", grouped(all)));
}

void draw_hashes(Widgets& w, const Session& session) {
  const std::uint64_t vertices = session.world().bodies().vertex_count();
  const collide::DebugGeometry& paper = session.inspector.paper_geometry();
  const bool known = paper.buckets > 0;
  const std::uint64_t corners = 8 * paper.boxes.size();
  w.figure("Hash evaluations", grouped(session.world().detection().counters.hashes),
           "Evaluations of the hash function by the driving method in this frame (§2.2).");
  w.figure("  corners of boxes", known ? grouped(corners) : "-",
           "The paper's method hashes eight corners per box. §3 claims that boxes save hashes: true if a box holds "
           "more than eight vertices.");
  w.figure("  vertices", grouped(vertices), "Grid Hash hashes each vertex.");
}

/// Draws the figures of the table that the hash table's view shows.
void draw_table(Widgets& w, const Session& session) {
  const collide::DebugGeometry& geometry = session.inspector.shown_geometry();
  const auto text = [&](std::size_t count, bool known) { return known ? grouped(count) : std::string("-"); };
  const bool known = geometry.buckets > 0;
  ImGui::TextDisabled("Table of %s", shown_method_text(session).c_str());
  w.register_item("Table", "The hash table of this method (§2.2). The view of the hash table (T) shows the same one.");
  const std::size_t boxes = geometry.boxes.size();
  w.figure("  boxes", text(boxes, known && boxes > 0), "Boxes with at least one vertex (§2.1).");
  w.figure("  buckets used", text(geometry.loads.size(), known), "Buckets with at least one entry (§2.2).");
  w.figure("  longest bucket", text(longest_bucket(geometry), known), "Entries of the fullest bucket (§2.2).");
}

}  // namespace

void draw_numbers(Widgets& w, const Session& session, const UiState& ui) {
  draw_curves(w, session, ui);
  draw_contacts(w, session);
  draw_surface_contacts(w, session);
  draw_pair_tests(w, session);
  draw_hashes(w, session);
  draw_table(w, session);
  draw_skipped(w, session);
  if (ui.render_scale < 1)
    w.figure("Resolution", fmt::format("{:.0f} %", 100 * double(ui.render_scale)),
             "Share of the pixels along each side of the scene's picture. It is below 100 % only while the scene moves "
             "and the machine is too slow for 30 pictures per second.");
}

}  // namespace app::ui

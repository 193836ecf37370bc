// The panel's section on counters and timings.

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/core.h>

#include "app/render/palette.h"
#include "app/ui/panel/panel.h"
#include "app/ui/views/status.h"
#include "softbody/measures.h"

namespace app::ui {
namespace {

constexpr std::array<const char*, collide::skip_kinds.size()> skip_tooltips{
    "Pairs of bodies whose boxes are out of reach of each other (§2.1).",
    "Pairs of bodies with near boxes that a plane across the line of centres, or the spheres around them, keeps apart.",
    "Bodies that no other body is near: there is no pair to look at.",
    "Bodies that are so little deformed that they cannot touch themselves (§2.4): no self pass.",
    "Pairs of near bodies that have not moved since the last frame: their contacts are kept, not found again."};
constexpr glm::vec3 detect_colour{0.835f, 0.369f, 0.000f}, solve_colour{0.000f, 0.447f, 0.698f};

void draw_curves(Widgets& w, const Session& session, float render_scale) {
  const session::StepHistory& history = session.simulation.history();
  const softbody::StepReport& report = session.world().last_step();
  const float ms = axis_end(std::max(history.detect_ms.max(), history.solve_ms.max()), 1.0f);
  w.curve("Detect", fmt::format("{:.2f} ms", report.detect_ms), history.detect_ms, {0, ms}, detect_colour, "ms");
  w.curve("Solve", fmt::format("{:.2f} ms", report.solve_ms), history.solve_ms, {0, ms}, solve_colour, "ms");
  w.curve("Picture", fmt::format("{:.1f} ms", history.frame_ms.latest()), history.frame_ms,
          {0, axis_end(history.frame_ms.max(), 20.0f)}, glm::vec3(0.45f), "ms from picture to picture");
  w.figure(
      "drawn at", fmt::format("{:.0f} %", 100 * double(render_scale)),
      "Of the pixels along each side, the scene's picture has so many. Less than 100 % only while it moves, "
      "where no graphics card draws and fewer than 30 pictures a second would come; what stands still, and what is "
      "taken away, has them all.");
  w.curve("Contacts found", grouped(session.world().detection().contacts.size()), history.contacts,
          {0, axis_end(history.contacts.max(), 10.0f)}, glm::vec3(0.45f), "contacts");
  const compare::CompareRow* driver = session.comparison.driver_row();
  const std::string value = driver ? fmt::format("{:.4f}", rounded_down(driver->recall)) : "-";
  w.curve("Recall", value, session.comparison.recall(), {0, 1}, glm::vec3(0.45f), "(the share of true contacts found)");
}

void draw_surface_contacts(Widgets& w, const Session& session) {
  if (session.world().scene().contact_surface != softbody::ContactSurface::surfaces) return;
  const auto& contacts = session.inspector.surface_contacts();
  const auto inside = static_cast<std::size_t>(std::ranges::count_if(
      contacts, [](const softbody::SurfaceContactPoint& contact) { return contact.a == contact.b; }));
  w.figure("surfaces, between bodies", grouped(contacts.size() - inside),
           "Vertices on faces and edges on edges of another body that pressed on each other in the last substep. "
           "Bodies that sleep are not looked at.");
  w.figure("surfaces, inside one body", grouped(inside), "The same within one body.");
}

/// Draws the work that the exact method has skipped, a line for each kind even if there is none, so that nothing moves.
void draw_skipped(Widgets& w, const Session& session) {
  const collide::Method& method = session.world().method();
  if (method.key != collide::default_method) return;
  ImGui::TextDisabled("Skipped in this frame");
  w.register_item("Skipped",
                  "Work that this frame did not need. Each kind is left out on a proof: the contacts are the same.");
  for (std::size_t kind = 0; kind < collide::skip_kinds.size(); ++kind) {
    const std::string label = "  " + std::string(collide::skip_kinds[kind].text);
    w.figure(label.c_str(), grouped(session.world().detection().skipped[kind]), skip_tooltips[kind]);
  }
}

/// Draws the pair tests beside the claims of §3.
void draw_pair_tests(Widgets& w, const Session& session) {
  const collide::Counters& counters = session.world().detection().counters;
  const std::uint64_t vertices = session.world().bodies().vertex_count();
  const std::uint64_t all =
      compare::all_pair_tests(session.world().bodies(), session.world().collision().self_collision);
  w.figure("Pair tests", grouped(counters.pair_tests),
           "Distances evaluated in this frame; brute force evaluates all (§2.3).");
  w.figure("  a vertex; of all pairs",
           fmt::format("{}; {} %", ratio(counters.pair_tests, vertices), ratio(100 * counters.pair_tests, all)),
           fmt::format("Pair tests of this frame over its {} vertices, and over all {} pairs. §3 claims O(1) at best: "
                       "as many a vertex, however many bodies there are; and O(N^2) at worst: all pairs.",
                       grouped(vertices), grouped(all))
               .c_str());
}

void draw_hashes(Widgets& w, const Session& session) {
  const std::uint64_t vertices = session.world().bodies().vertex_count();
  const std::uint64_t corners = 8 * session.inspector.paper_geometry().boxes.size();
  w.figure("Hash evaluations", grouped(session.world().detection().counters.hashes),
           "Evaluations of the hash function in this frame: 8 corners a box for the literal method (§2.2).");
  w.figure("  corners / vertices", fmt::format("{} / {}", grouped(corners), grouped(vertices)),
           fmt::format("What the paper's method hashes, eight corners a box, against what a vertex hash does: {} a "
                       "vertex. §3 claims that boxes save hashes: true while a box holds more than eight vertices. "
                       "Both grow with the number of bodies.",
                       ratio(corners, vertices))
               .c_str());
}

}  // namespace

void draw_numbers(Widgets& w, const Session& session, float render_scale) {
  draw_curves(w, session, render_scale);
  const collide::Result& found = session.world().detection();
  const collide::Counters& counters = found.counters;
  w.figure("between bodies", grouped(found.contacts.size() - found.self_contacts),
           "Contacts whose two vertices belong to two bodies (§2.3).");
  w.figure("inside one body", grouped(found.self_contacts), "Self-collisions (§2.4).");
  w.figure("with solids", grouped(softbody::solid_contacts(session.world()).size()),
           "Vertices that touch a solid sphere or the ground. Found by distance, not by the method.");
  draw_surface_contacts(w, session);
  draw_pair_tests(w, session);
  draw_hashes(w, session);
  w.figure("Boxes", grouped(counters.boxes), "Boxes that hold a vertex (§2.1).");
  w.figure("Buckets used", grouped(counters.buckets_used), "Buckets with at least one entry (§2.2).");
  w.figure("Longest bucket", grouped(counters.longest_bucket), "Entries of the fullest bucket (§2.2).");
  draw_skipped(w, session);
}

}  // namespace app::ui

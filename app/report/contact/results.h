#pragma once
// What `report contact` measures, and its table, page and plots.

#include <optional>
#include <string>
#include <vector>

#include "app/base/timings.h"
#include "app/report/page.h"
#include "softbody/world/world.h"

namespace app::report {

/// A kind of contact.
struct ContactChoice {
  softbody::ContactSurface surface = softbody::ContactSurface::vertices;
  std::string_view method = collide::default_method;  // has no effect on surface contact, nor has the tolerance
  double tolerance = 1;                               // times the scene's own
};

struct TrialLimits {
  int frames = 900;
  int stride = 10;      // frames between looks for overlaps
  double seconds = 60;  // of processor time
};

struct ContactTrial {
  ContactChoice choice{};
  std::string not_run{};  // why it was not run to the end; if empty, all of these have a meaning
  double tolerance = 0;   // m
  double radius = 0;      // R, m: of the smallest closed body; 0: there is none, and depths have no meaning
  collide::Index bodies = 0, vertices = 0;
  int frames = 0;  // fewer than the limit if all bodies fell asleep or something was not finite
  int looks = 0;
  double cpu_ms = 0, detect_ms = 0, solve_ms = 0;  // means a frame: processor time of a step; clock time of its parts
  TimedParts timed{};                              // all steps
  // Over all looks:
  std::size_t penetrations = 0;        // vertices inside other bodies
  std::size_t missed = 0;              // of those, joined to that body by no contact of the detector
  double deepest = 0, mean_depth = 0;  // m
  double solid_depth = 0;              // m, the deepest particle in a solid
  // Over all frames:
  std::size_t crossed_vertices = 0, edge_crossings = 0;  // the oracle's: through faces and through edges
  std::size_t passed = 0;                                // vertices that came to be on the other side: see the .cpp
  std::size_t through_solids = 0;                        // times that the middle of a closed body went through a solid
  // At the end:
  bool finite = true;
  bool settles = false;                                      // the scene has gravity, so its bodies should come to rest
  bool asleep = false;                                       // all of them
  double end_depth = 0;                                      // m, deepest penetration
  std::size_t overlapping_pairs = 0, self_intersecting = 0;  // pairs of bodies; bodies
  double jitter = 0;  // m/s, RMS over the last second of the particles whose bodies do not sleep; 0: all sleep

  static constexpr double depth_bound = 0.02;  // R
  bool was_run() const { return not_run.empty(); }
  /// Returns a depth in R; 0 where it has no meaning.
  double in_radii(double depth) const { return radius > 0 ? depth / radius : 0; }
  /// Returns what is wrong, in words; nothing if it passes.
  std::vector<std::string> failures() const;
};

/// Runs on one thread. The result is the same on every machine, except for times and where limits.seconds cuts it
/// short. If the scene or the choice does not allow the run, not_run says so.
ContactTrial run_contact_trial(softbody::Scene scene, const ContactChoice& choice, const TrialLimits& limits);

/// Returns a scene without gravity in which a sphere is thrown at something with that speed (m/s).
using Impact = softbody::Scene (*)(double speed);
/// Returns all impacts: at a resting sphere, at the solid sphere, at a hanging sheet. Materials are those of the scenes
/// A and cloth.
std::span<const Impact> impacts();

/// A scene, or an impact at one speed.
struct ContactCase {
  softbody::Scene scene;
  TrialLimits limits;
  std::optional<double> speed{};       // m/s, of an impact
  std::vector<ContactTrial> trials{};  // in the order of the choices
};

struct ContactResults {
  ReportOptions options{};
  TrialLimits limits{};                  // of scenes
  std::uint64_t vertex_frames = 0;       // budget: a scene with more vertices times frames is not run
  std::vector<ContactChoice> choices{};  // surface contact first
  std::vector<ContactCase> cases{};      // scenes, then impacts, each impact by speed
};

/// Returns "Surface", or "Vertex-vertex, exact, x 0.4".
std::string choice_name(const ContactChoice& choice);

/// Returns contact.csv: a row per case and choice. What has no meaning or was not run is empty.
Table contact_table(const ContactResults& results);

Page contact_page(const ContactResults& results);

/// Makes the report: how accurate each kind of contact is, judged by the surface oracle, and what it costs.
void report_contact(const ReportOptions& options);

}  // namespace app::report

#pragma once
// What `report contact` measures, and its table, page and plots.

#include <span>
#include <string>
#include <vector>

#include "app/report/contact/trial.h"
#include "app/report/page.h"

namespace app {

/// A scene, or an impact at one speed.
struct ContactCase {
  bool impact = false;
  std::string key{}, name{};
  double speed = 0;                    // m/s, of an impact
  std::vector<ContactTrial> trials{};  // as the choices; empty while they are to be run
};

struct ContactResults {
  std::string command;  // to make the report again
  bool quick = false;
  TrialLimits limits;                  // of scenes
  std::uint64_t vertex_frames = 0;     // budget: scenes with more vertices times frames are not run
  std::vector<ContactChoice> choices;  // surface contact first
  std::vector<ContactCase> cases;      // scenes, then impacts, of each kind by speed
};

/// Returns "Surface", or "Vertex-vertex, exact, x 0.4".
std::string choice_name(const ContactChoice& choice);

/// Returns contact.csv: a row per case and choice. What has no meaning or was not run is empty.
Table contact_table(const ContactResults& results);

Page contact_page(const ContactResults& results);

/// Returns the plot of a scene: the deepest penetration against run time.
Plot depth_against_time(const ContactCase& c);
/// Returns the plot of one impact at several speeds: how much passed through.
Plot passed_against_speed(std::span<const ContactCase> cases);

}  // namespace app

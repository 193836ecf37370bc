#pragma once
// What `report contact` measures, and its table, page and plots.

#include <string>
#include <vector>

#include "app/report/contact/trial.h"
#include "app/report/page.h"

namespace app::report {

/// A scene, or an impact at one speed.
struct ContactCase {
  bool impact = false;
  std::string key{}, name{};
  double speed = 0;                    // m/s, of an impact
  std::vector<ContactTrial> trials{};  // in the order of the choices
};

struct ContactResults {
  ReportOptions options{};
  TrialLimits limits;                  // of scenes
  std::uint64_t vertex_frames = 0;     // budget: a scene with more vertices times frames is not run
  std::vector<ContactChoice> choices;  // surface contact first
  std::vector<ContactCase> cases;      // scenes, then impacts, each impact by speed
};

/// Returns "Surface", or "Vertex-vertex, exact, x 0.4".
std::string choice_name(const ContactChoice& choice);

/// Returns contact.csv: a row per case and choice. What has no meaning or was not run is empty.
Table contact_table(const ContactResults& results);

Page contact_page(const ContactResults& results);

}  // namespace app::report

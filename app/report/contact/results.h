#pragma once
// What `report contact` has measured, and what it is written as.

#include <string>
#include <vector>

#include "app/report/contact/trial.h"
#include "app/report/plot.h"

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

/// "Surface", or "Vertex-vertex, exact, x 0.4".
std::string choice_name(const ContactChoice& choice);

/// A row a case and choice, with a header line. What has no meaning or was not run is empty.
std::string contact_csv(const ContactResults& results);

/// The deepest penetration against run time for each scene; against speed, how much passed through, for each impact.
std::vector<Plot> contact_plots(const ContactResults& results);
std::string contact_plot_name(const ContactCase& c);

/// plots: those that lie beside it as NAME.svg and NAME.png.
std::string contact_markdown(const ContactResults& results, const std::vector<Plot>& plots);

}  // namespace app

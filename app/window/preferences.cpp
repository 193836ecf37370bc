#include "app/window/preferences.h"

#include <array>
#include <utility>

#include "app/files/output_file.h"
#include "softbody/scene/toml_table.h"
#include "softbody/scene/toml_text.h"

namespace app::window {
namespace fs = std::filesystem;
namespace {

constexpr int min_side = 240, max_side = 16384;  // of the window

struct Flag {
  const char* key;
  bool ui::Remembered::*value;
};
constexpr std::array flags{Flag{"panel", &ui::Remembered::panel}, Flag{"lights", &ui::Remembered::lights},
                           Flag{"hash_table", &ui::Remembered::hash_table},
                           Flag{"story", &ui::Remembered::story_at_start}};
constexpr std::array<std::string_view, 3> lower_views{"none", "comparison", "error_time"};  // by ui::LowerView

/// Ignores the keys of other versions of the program.
Preferences read(softbody::Table root) {
  Preferences p;
  p.size.x = root.integer("width", p.size.x, min_side, max_side);
  p.size.y = root.integer("height", p.size.y, min_side, max_side);
  p.slow_factor = root.number("slow_motion", p.slow_factor, session::SimulationClock::min_slow_factor,
                              session::SimulationClock::max_slow_factor);
  for (const auto& [key, value] : flags) p.shown.*value = root.boolean(key, p.shown.*value);
  p.picture_with_panel = root.boolean("picture_with_panel", p.picture_with_panel);
  const auto lower = std::ranges::find(lower_views, root.text("below", ""));
  if (lower != lower_views.end()) p.shown.lower = static_cast<ui::LowerView>(lower - lower_views.begin());
  softbody::Table shown = root.child("show");
  for (const render::OverlayRow& row : render::overlay_table) {
    bool& on = p.shown.overlays.*row.shown;
    on = shown.boolean(std::string(row.key), on);
  }
  softbody::Table methods = root.child("methods");
  for (std::size_t m = 0; m < p.methods.size(); ++m)
    p.methods[m] = methods.boolean(collide::method_table()[m].key, p.methods[m]);
  for (softbody::Table& section : root.children("section"))
    p.shown.sections[section.text("name", "")] = section.boolean("open", true);
  return p;
}

std::string text_of(const Preferences& p) {
  softbody::TomlLines out;
  out.add("width", p.size.x).add("height", p.size.y).add("slow_motion", p.slow_factor);
  for (const auto& [key, value] : flags) out.add(key, p.shown.*value);
  out.add("picture_with_panel", p.picture_with_panel);
  out.add("below", lower_views[static_cast<std::size_t>(p.shown.lower)]);
  out.heading("[show]");
  for (const render::OverlayRow& row : render::overlay_table) out.add(row.key, p.shown.overlays.*row.shown);
  out.heading("[methods]");
  for (std::size_t m = 0; m < p.methods.size(); ++m)
    if (const collide::Method& method = collide::method_table()[m]; method.can_drive())  // else it comes and goes
      out.add(method.key, bool{p.methods[m]});
  for (const auto& [name, open] : p.shown.sections) out.heading("[[section]]").add("name", name).add("open", open);
  return out.text();
}

}  // namespace

Preferences first_preferences(glm::ivec2 size) {
  constexpr int for_panel = 900, for_lights = 1200, for_hash_table = 1600;  // widths in screen coordinates
  Preferences p;
  p.size = size;
  p.shown.panel = size.x >= for_panel;
  p.shown.lights = size.x >= for_lights;
  p.shown.hash_table = size.x >= for_hash_table;
  return p;
}

Preferences preferences_of(const Session& session, const ui::UiState& ui, glm::ivec2 size) {
  Preferences p{size, ui, session.exporter.with_panel, session.simulation.clock.slow_factor,
                session.comparison.choice.methods};
  p.shown.overlays = ui.tour.saved_overlays().value_or(ui.overlays);
  return p;
}

void apply(const Preferences& p, Session& session, ui::UiState& ui) {
  static_cast<ui::Remembered&>(ui) = p.shown;
  session.simulation.clock.slow_factor = p.slow_factor;
  session.exporter.with_panel = p.picture_with_panel;
  session.comparison.choice.methods = p.methods;
}

PreferencesFile::PreferencesFile(fs::path file) : file_(std::move(file)) {
  std::error_code error;
  if (!file_.empty() && fs::exists(file_, error)) {
    is_new_ = false;
    try {
      const toml::table table = softbody::read_toml(file_);
      stored_ = read(softbody::Table(table, file_.string(), ""));
    } catch (const std::exception& broken) {
      problem_ = std::string(broken.what()) + "; these preferences are ignored";
    }
  }
  pending_ = stored_;
}

std::string PreferencesFile::store(const Preferences& now, double seconds, bool last) {
  if (file_.empty()) return {};
  if (!(now == pending_)) {
    pending_ = now;
    pending_since_ = seconds;
  }
  if (pending_ == stored_ || (!last && seconds - pending_since_ < settling)) return std::exchange(problem_, {});
  stored_ = pending_;  // also if writing fails: the problem is reported once per change, not once per frame
  try {
    fs::create_directories(file_.parent_path());
    files::write_file(file_, text_of(stored_));
  } catch (const std::exception& error) {
    problem_ = "preferences cannot be kept: " + std::string(error.what());
  }
  return std::exchange(problem_, {});
}

}  // namespace app::window

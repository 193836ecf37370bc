#include "app/ui/parts.h"

#include <algorithm>

#include <fmt/core.h>

namespace app::ui {
namespace {

constexpr float padding = 4, button_width = 64, state_width = 205, speed_width = 110;  // design pixels

bool is_slowed(const session::SimulationClock& clock) { return !clock.paused && clock.pace() < 0.95; }

std::string state_text(const Session& session) {
  const softbody::BodiesInMotion& world = session.world();
  const session::SimulationClock& clock = session.simulation.clock;
  if (clock.paused) return "paused";
  if (is_slowed(clock)) return fmt::format("slowed to {:.0f} %: {}", 100 * clock.pace(), session.slowest_part());
  const std::size_t count = world.bodies().count(), more = bodies_to_come(world);
  std::string text = fmt::format("{} {}", grouped(count), count == 1 ? "body" : "bodies");
  if (more > 0) return text + fmt::format(", {} to come", grouped(more));
  return text + (session.simulated() && world.all_at_rest() ? ", all at rest" : "");
}

/// Draws the slider through all frames that can be played, whether they were shown or not.
void draw_frames(Widgets& w, const session::Player& player) {
  int frame = player.frame();
  const int last = player.recording()->frame_count() - 1;
  const Disabled off(last == 0);
  if (w.slider("Time line", frame, 0, last,
               last == 0 ? "the only frame" : fmt::format("frame %d of {}", grouped(std::uint64_t(last))).c_str(),
               "Drag it to any frame; frames count from 0. It pauses there."))
    w.ask([frame](Session& s) { s.simulation.rewind_to(frame); });
}

/// Draws how fast the frames that are played follow each other, and whether they begin again.
void draw_speed(Widgets& w, const Session& session) {
  const double frame_time = session.world().frame_time();
  double rate = session.simulation.clock.speed / frame_time;
  if (w.checkbox("Loop", session.simulation.loop, "Begins again after the last frame, and else pauses there."))
    w.ask([](Session& s) { s.simulation.loop = !s.simulation.loop; });
  ImGui::SameLine();
  ImGui::SetNextItemWidth(w.px(speed_width));
  if (w.slider("Speed", rate, 1, 240, "%.0f frames/s", "How many frames are shown each second.", true))
    w.ask([speed = rate * frame_time](Session& s) { s.simulation.clock.speed = speed; });
  ImGui::SameLine();
}

/// Draws the slider from the first snapshot to the newest.
void draw_past(Widgets& w, const Session& session) {
  const auto& past = session.simulation.stability().past();
  const auto& kept = past.snapshots();
  const int frame = session.world().frame(), last = std::max(0, static_cast<int>(kept.size()) - 1);
  const Disabled off(kept.empty());
  int place = kept.empty() ? 0 : static_cast<int>(past.at(frame));
  const std::string shown = fmt::format("frame {}, {:.2f} s", frame, session.world().last_step().time);
  if (w.slider(
          "Time line", place, 0, last, shown.c_str(),
          fmt::format("Drag it to go back in time. The world pauses there and continues from there, exactly as "
                      "it did unless you change something. {} snapshots, {:.1f} of at most {} MiB: dense in the "
                      "recent past, sparse further back.",
                      kept.size(), static_cast<double>(past.bytes()) / (1 << 20), session::Rewind::max_bytes >> 20)))
    w.ask([to = kept[static_cast<std::size_t>(place)].frame](Session& s) { s.simulation.rewind_to(to); });
}

void draw_state_text(Widgets& w, const Session& session) {
  ImGui::SameLine();
  ImGui::SetCursorPosY(ImGui::GetCursorPosY() + ImGui::GetStyle().FramePadding.y);
  w.right_text(state_text(session));
  w.register_item("Progress", is_slowed(session.simulation.clock)
                                  ? "The machine does not keep up, or frames take more work than is allowed: the "
                                    "simulation runs slower than real time. Behind the colon stands what takes most."
                                  : "What the simulation does now.");
}

}  // namespace

std::size_t bodies_to_come(const softbody::BodiesInMotion& world) {
  // A step brings the bodies of the frame before it; the first ones are there at once.
  const auto comes = [&](const softbody::BodySource& body) { return body.appear >= std::max(world.frame(), 1); };
  return static_cast<std::size_t>(std::ranges::count_if(world.scene().bodies, comes));
}

float time_line_height(float scale) { return ImGui::GetFrameHeight() + 2 * padding * scale; }

void draw_time_line(Widgets& w, const Session& session, const ScreenRect& area) {
  const ImGuiStyle& style = ImGui::GetStyle();
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {style.WindowPadding.x, w.px(padding)});
  begin_dock("Time line", area, false, ImGuiWindowFlags_NoScrollbar);
  ImGui::PopStyleVar();
  if (w.button(session.simulation.clock.paused ? "Resume###Pause" : "Pause###Pause",
               "Pauses or resumes the simulation (Space).", w.px(button_width)))
    w.ask([](Session& s) { s.simulation.clock.paused = !s.simulation.clock.paused; });
  ImGui::SameLine();
  const session::Player* player = session.simulation.player();
  if (w.button("Step",
               player ? "Shows the next frame, then pauses (N)." : "Simulates one frame of 1/60 s, then pauses (N).",
               w.px(button_width)))
    w.ask([](Session& s) { s.simulation.clock.single_step(); });
  ImGui::SameLine();
  if (player) draw_speed(w, session);
  const float room = ImGui::GetContentRegionAvail().x;
  const bool has_state = room >= w.px(2 * state_width);
  ImGui::SetNextItemWidth(has_state ? room - w.px(state_width) : room);
  if (player)
    draw_frames(w, *player);
  else
    draw_past(w, session);
  if (has_state) draw_state_text(w, session);
  ImGui::End();
}

}  // namespace app::ui

#include "app/window/open_session.h"

#include <chrono>
#include <cstdlib>
#include <future>
#include <string>

#include <imgui.h>

#include "app/window/frame_timer.h"

namespace app::window {

std::unique_ptr<Session> open_session(const DemoOptions& options, Graphics& graphics) {
  std::future<std::unique_ptr<Session>> opening = std::async(std::launch::async, [&] {
    return std::make_unique<Session>(options.opened, options.scene_folder, options.threads, options.scene_name);
  });
  std::future_status status = opening.wait_for(std::chrono::milliseconds(300));
  for (const double began = now(); status != std::future_status::ready;) {
    status = opening.wait_for(std::chrono::milliseconds(30));
    graphics.window.poll();
    if (!graphics.window.is_open()) std::quick_exit(EXIT_SUCCESS);  // there is nothing to lose yet
    if (graphics.window.minimised()) continue;
    const std::string text =
        "Opening " + options.scene_name + ": " + std::to_string(static_cast<int>(now() - began)) + " s so far";
    graphics.gui.begin_frame();
    graphics.gui.take_key_presses();  // there is no session yet that they could be for
    const ImVec2 room = ImGui::GetIO().DisplaySize, size = ImGui::CalcTextSize(text.c_str());
    ImGui::GetForegroundDrawList()->AddText({(room.x - size.x) / 2, (room.y - size.y) / 2},
                                            ImGui::GetColorU32(ImGuiCol_Text), text.c_str());
    graphics.gui.end_frame();
    graphics.clear();
    graphics.gui.draw();
    graphics.window.present();
  }
  while (graphics.window.has_pending_input())
    graphics.window.take_input();  // the remaining input is not for the session either
  return opening.get();
}

}  // namespace app::window

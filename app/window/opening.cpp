#include "app/window/opening.h"

#include <chrono>
#include <cstdlib>
#include <future>
#include <string>

#include <imgui.h>

#include "app/window/pacer.h"

namespace app {

std::unique_ptr<Session> open_session(const DemoOptions& options, Screen& screen) {
  std::future<std::unique_ptr<Session>> opening = std::async(std::launch::async, [&] {
    return std::make_unique<Session>(options.scene, options.scene_folder, options.threads, options.scene_name);
  });
  std::future_status status = opening.wait_for(std::chrono::milliseconds(300));
  for (const double began = now(); status != std::future_status::ready;) {
    status = opening.wait_for(std::chrono::milliseconds(30));
    screen.window.poll();
    if (!screen.window.is_open()) std::quick_exit(EXIT_SUCCESS);  // there is nothing yet that could be lost
    if (screen.window.minimised()) continue;
    const std::string text =
        "Opening " + options.scene_name + ": " + std::to_string(static_cast<int>(now() - began)) + " s so far";
    screen.gui.begin_frame();
    screen.gui.take_key_presses();  // there is nothing yet that they could be meant for
    const ImVec2 room = ImGui::GetIO().DisplaySize, size = ImGui::CalcTextSize(text.c_str());
    ImGui::GetForegroundDrawList()->AddText({(room.x - size.x) / 2, (room.y - size.y) / 2},
                                            ImGui::GetColorU32(ImGuiCol_Text), text.c_str());
    screen.gui.end_frame();
    screen.clear();
    screen.gui.draw();
    screen.window.present();
  }
  while (screen.window.has_pending_input()) screen.window.take_input();  // nor is what is left of it for the session
  return opening.get();
}

}  // namespace app

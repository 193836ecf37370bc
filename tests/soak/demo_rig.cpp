#include "tests/soak/demo_rig.h"

#include <utility>

#include "app/window/scene_picture.h"
#include "engine/resources.h"

namespace soak {

DemoRig::DemoRig(const std::filesystem::path& scenes, const std::filesystem::path& folder)
    : view_(engine::find_folder("shaders")), session(softbody::find_scene("drop", scenes), scenes, 2) {
  session.exporter.folder = session.import.path = folder.string();
  ui.save_as = (folder / "saved.toml").string();
  restart_camera();
}

void DemoRig::resize(glm::ivec2 size) {
  input.display_size = size;
  target_ = engine::Framebuffer(size, 0);
}

void DemoRig::frame(bool draw) {
  target_.bind();
  gui_.begin_frame(input);
  session.import.update();
  carry_out({}, session, ui);
  carry_out(interface_.draw(session, ui, gui_.scale()), session, ui);
  const bool over_scene = !gui_.wants_mouse();
  carry_out(mouse_.update(app::window::read_mouse({}, over_scene), session, ui, camera_, input.display_size), session,
            ui);
  camera_.advance(input.seconds);
  const app::window::ScenePicture picture = app::window::scene_picture(session, ui, camera_, 1);
  if (draw)
    canvas_.update(input.display_size, true, session.exporter.wants_shown_picture(), [&](const auto& whole) {
      for (const app::window::HalfPicture& half : app::window::halves(picture, whole))
        view_.draw(session.simulation.world(half.half),
                   app::window::overlay_request(session, ui.tour, picture, half.half), half.camera, half.viewport, 1,
                   app::window::drawn_meshes(session, picture.between, half.half));
    });
  target_.bind();
  gui_.end_frame();
  gui_.draw();
  session.exporter.frame([this](bool with_panel, const auto&) { return with_panel ? target_.read() : canvas_.read(); });
  session.advance_one(input.seconds);
  glFinish();  // as a window does: else software drivers keep the memory of pictures that they have not drawn yet
}

}  // namespace soak

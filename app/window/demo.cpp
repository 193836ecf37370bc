#include "app/window/demo.h"

#include <chrono>
#include <cmath>
#include <cstdlib>
#include <future>
#include <memory>
#include <optional>
#include <stdexcept>
#include <utility>

#include "app/ui/interface.h"
#include "app/ui/shortcuts.h"
#include "app/ui/tour/card.h"
#include "app/window/opening.h"
#include "app/window/overlay_request.h"
#include "app/window/pacer.h"
#include "app/window/preferences.h"
#include "app/window/scene_mouse.h"
#include "app/window/screen.h"
#include "engine/context.h"
#include "engine/gl.h"

namespace app {
namespace {

/// All that a picture of the scene depends on.
struct PictureKey {
  std::uint64_t revision = 0, comparison = 0, judgement = 0, tour = 0;
  std::size_t misses_of = 0;
  Overlays overlays;
  std::optional<std::uint32_t> bucket;
  std::optional<Cell> cell;
  std::optional<softbody::BodyId> selected;
  std::optional<softbody::Grab> grab;
  glm::mat4 view{0.0f};
  float scale = 0, between = 1;
  bool operator==(const PictureKey&) const = default;
};

class Demo {
 public:
  explicit Demo(const DemoOptions& options)
      : preferences_(preferences_path()),
        screen_(std::make_unique<Screen>(options.size_given ? glm::ivec2(options.width, options.height)
                                                            : preferences_.kept().size)),
        opened_(open_session(options, *screen_)),
        session_(*opened_) {
    session_.set_integrator(options.integrator, options.substeps);
    apply(preferences_.kept(), session_, ui_);
    keep_preferences();
    ui_.import.drop(options.meshes, session_);
  }

  void run() {
    while (screen_->window.open() && !ui_.quit) {
      screen_->window.poll(pacer_.spare());
      const double elapsed = pacer_.tick();
      if (screen_->window.minimised()) continue;  // poll() has slept; the world waits for its window
      frame(elapsed);
    }
    keep_preferences(true);
    // A balance that is being sought could hold a closed window for minutes.
    if (ui_.import.busy() && !ui_.exporter.recording() && !ui_.exporter.finishing()) std::quick_exit(EXIT_SUCCESS);
  }

 private:
  void frame(double elapsed) {
    if (screen_->window.context_lost()) renew_screen();
    try {
      draw_frame(elapsed);
    } catch (const std::runtime_error&) {  // what a lost context refuses; the next frame finds another
      if (!screen_->window.context_lost()) throw;
      renew_screen();
    }
  }

  /// The world goes on in a new window. Throws engine::Unavailable if there is none, or it did not last either.
  void renew_screen() {
    keep_preferences(true);
    if (now() - renewed_ < shortest_screen)
      throw engine::Unavailable(
          "the graphics driver was reset again and again: update it, or set LIBGL_ALWAYS_SOFTWARE=1");
    const glm::ivec2 size = window_size();
    screen_->window.wait_for_reset();
    screen_.reset();  // one window at a time
    screen_ = std::make_unique<Screen>(size);
    drawn_ = {};
    renewed_ = now();
    session_.set_notice("the graphics driver was reset: the window was made anew, nothing else was lost");
  }

  void handle_keys() {
    for (const engine::KeyPress& key : screen_->gui.take_key_presses())
      if (press(key.key, key.repeat, session_, ui_, key.mods) ||
          press(key.otherwise, key.repeat, session_, ui_, key.mods))
        seconds_ += key_hint_seconds;
  }

  /// Begins a frame of the Gui, and does what it is told of mouse and keyboard.
  void take_input(double elapsed) {
    screen_->gui.begin_frame();
    handle_keys();
    interface_.draw(session_, ui_, screen_->gui.scale(), seconds_);
    const engine::Viewport viewport = scene_viewport();
    move_camera(viewport, elapsed);
    do_as_asked(viewport);
  }

  void draw_frame(double elapsed) {
    seconds_ += elapsed;
    ui_.import.drop(screen_->window.take_dropped_files(), session_);
    if (screen_->window.input_waits() || ui_.exporter.recording()) pacer_.stir();
    // Whatever waits of mouse and keyboard, a click at a time: a slow world does not keep those who type or click.
    take_input(elapsed);
    while (screen_->window.input_waits()) {
      screen_->gui.end_frame();
      take_input(0);
    }
    const engine::Viewport viewport = scene_viewport();
    double drawing = timed([&] { draw_scene(viewport); });
    if (const Highlight* light = ui_.tour.highlight())
      draw_labels(light->labels, camera_, viewport.size, interface_.scene_area(), screen_->gui.scale());
    ui_.view = SceneView::view(camera_, viewport.size);
    screen_->gui.end_frame();
    ui_.exporter.frame(session_, [this](bool with_panel) { return picture(with_panel); });
    if (!ui_.quit) advance(elapsed);  // while the driver draws
    drawing += timed([&] { present(viewport); });
    screen_->canvas.pace(elapsed, drawing);
    keep_preferences();
    pacer_.rest();
  }

  /// Steps that take long run beside the window: meanwhile one can look round, and what is typed or clicked is kept.
  void advance(double elapsed) {
    const auto advance = [&] {
      if (ui_.exporter.recording())
        session_.advance_one(elapsed, ui_.exporter.may_step());
      else
        session_.advance(elapsed);
    };
    if (session_.step_ms() < long_step_ms) return advance();
    present(scene_viewport());
    std::future<void> done = std::async(std::launch::async, advance);
    for (double last = now(); done.wait_for(std::chrono::milliseconds(10)) != std::future_status::ready;)
      look_around(now() - std::exchange(last, now()));
    done.get();
  }

  /// Moves the camera over what was drawn last, and touches nothing that a step writes.
  void look_around(double elapsed) {
    screen_->window.poll();
    const engine::Viewport viewport = scene_viewport();
    if (drawn_ == PictureKey{} || screen_->window.minimised() || viewport.size.x <= 0 || viewport.size.y <= 0) return;
    if (screen_->window.left_button_down())
      mouse_.turn_on(screen_->window.cursor() - corner(viewport), camera_, viewport.size);
    camera_.advance(elapsed);
    if (camera_.view() == drawn_.view) return;
    drawn_.view = camera_.view();
    screen_->canvas.update(viewport.size, true, false, [&](const engine::Viewport& whole) {
      screen_->view.redraw(camera_, whole, pixel_scale(whole, viewport));
    });
    present(viewport);
  }

  void present(const engine::Viewport& viewport) const {
    compose(viewport);
    screen_->window.present();
  }

  /// The window's picture, of the scene's and the panel's.
  void compose(const engine::Viewport& viewport) const {
    screen_->clear();
    if (viewport.size.x > 0 && viewport.size.y > 0) screen_->canvas.show(viewport.origin);
    screen_->gui.draw();
  }

  /// Of what is about to be shown.
  engine::Image picture(bool with_panel) const {
    if (!with_panel) return screen_->canvas.read();
    compose(scene_viewport());
    return engine::read_pixels(0, screen_->window.framebuffer_size());
  }

  /// On an ordinary screen it would have this one.
  glm::ivec2 window_size() const {
    return glm::ivec2(glm::round(glm::vec2(screen_->window.framebuffer_size()) / screen_->window.content_scale()));
  }

  void keep_preferences(bool last = false) {
    preferences_.keep(preferences_of(session_, ui_, window_size()), seconds_, last);
    if (std::string problem = preferences_.take_problem(); !problem.empty()) session_.set_notice(std::move(problem));
  }

  engine::Viewport scene_viewport() const {
    const ImVec2 ratio = ImGui::GetIO().DisplayFramebufferScale;
    const SceneArea area = interface_.scene_area();
    const auto pixels = [](float at, float factor) { return static_cast<int>(std::lround(at * factor)); };
    const glm::ivec2 lo(pixels(area.min.x, ratio.x), pixels(area.min.y, ratio.y));
    const glm::ivec2 hi(pixels(area.max.x, ratio.x), pixels(area.max.y, ratio.y));
    return {{lo.x, screen_->window.framebuffer_size().y - hi.y}, glm::max(hi - lo, 0)};
  }

  void move_camera(const engine::Viewport& viewport, double elapsed) {
    if (ui_.reset_camera || shown_scene_ != session_.world().scene().key) {
      shown_scene_ = session_.world().scene().key;
      camera_ = screen_->view.camera(session_.world().scene(), viewport.size);
      fitted_ = viewport.size;
      ui_.reset_camera = false;
      before_tour_.reset();
    }
    refit(viewport.size);
    mouse_.follow(read_mouse(corner(viewport), !screen_->gui.wants_mouse()), session_, camera_, viewport.size);
    frame_tour(viewport);
    if (mouse_.on_body()) ImGui::SetMouseCursor(ImGuiMouseCursor_Hand);
    camera_.advance(elapsed);
  }

  /// The scene keeps its extent when what stands beside it comes or goes. During the tour it is framed otherwise.
  void refit(glm::ivec2 size) {
    if (ui_.tour.open() || before_tour_ || size.x <= 0 || size.y <= 0) return;
    if (fitted_.x > 0 && fitted_ != size) SceneView::refit(camera_, fitted_, size);
    fitted_ = size;
  }

  /// The tour moves the camera, and gives it back.
  void frame_tour(const engine::Viewport& viewport) {
    if (ui_.tour.open() && !before_tour_) before_tour_ = camera_.orbit();
    if (!ui_.tour.open() && before_tour_) camera_.glide_to(*std::exchange(before_tour_, std::nullopt));
    if (!ui_.tour.take_framing()) return;
    const Highlight& light = *ui_.tour.highlight();
    camera_.glide_to(light.centre, tour_room * light.radius, viewport.size);
  }

  /// Its top left one in the window, whose pixels are counted from there.
  glm::vec2 corner(const engine::Viewport& viewport) const {
    return {viewport.origin.x, screen_->window.framebuffer_size().y - viewport.origin.y - viewport.size.y};
  }

  /// What the panel and the keys ask for that needs the camera.
  void do_as_asked(const engine::Viewport& viewport) {
    if (std::exchange(ui_.throw_body, false)) {
      const engine::Ray ray = mouse_.ray(camera_, viewport.size);
      session_.throw_body(glm::dvec3(ray.origin), glm::dvec3(ray.direction));
    }
    if (std::exchange(ui_.look_at_body, false) && session_.selected_body())
      look_at(*session_.selected_body(), session_, camera_, viewport.size);
  }

  void draw_scene(const engine::Viewport& viewport) {
    if (viewport.size.x <= 0 || viewport.size.y <= 0) return;
    const PictureKey key = picture_key();
    const bool still = (session_.paused || session_.world().all_at_rest()) && key == drawn_;
    const bool fine = still || ui_.exporter.wants_picture();
    screen_->canvas.update(viewport.size, key != drawn_, fine, [&](const engine::Viewport& whole) {
      screen_->view.draw(session_.world(), overlay_request(session_, ui_), camera_, whole, pixel_scale(whole, viewport),
                         session_.drawn_positions(whole_steps(session_, ui_.overlays)));
    });
    ui_.render_scale = screen_->canvas.render_scale();
    if (!still) pacer_.stir();
    drawn_ = key;
  }

  float pixel_scale() const { return std::max(screen_->window.content_scale(), screen_->window.pixel_ratio()); }
  /// In a picture `whole` that is to be stretched to the viewport.
  float pixel_scale(const engine::Viewport& whole, const engine::Viewport& viewport) const {
    return pixel_scale() * static_cast<float>(whole.size.y) / static_cast<float>(viewport.size.y);
  }

  PictureKey picture_key() const {
    const Overlays& shown = ui_.overlays;
    return {.revision = session_.revision(),
            .comparison = shown.missed ? session_.comparisons() : 0,
            .judgement = shown.true_surfaces ? session_.surfaces().reports() : 0,
            .tour = ui_.tour.changes(),
            .misses_of = session_.misses_of(),
            .overlays = shown,
            .bucket = session_.selected_bucket(),
            .cell = session_.selected_cell(),
            .selected = session_.selected_body(),
            .grab = session_.world().grabbed(),
            .view = camera_.view(),
            .scale = pixel_scale(),
            .between = whole_steps(session_, ui_.overlays) ? 1.0f : session_.between()};
  }

  static constexpr float tour_room = 0.6f;       // glide_to() leaves half of the picture free: less is enough
  static constexpr double shortest_screen = 10;  // s between two losses of the context
  static constexpr double long_step_ms = 50;
  static constexpr double key_hint_seconds = 5;  // whoever uses keys needs the hint less

  PreferencesFile preferences_;
  std::unique_ptr<Screen> screen_;
  std::unique_ptr<Session> opened_;
  Session& session_;
  Interface interface_;
  UiState ui_;
  engine::Camera camera_;
  SceneMouse mouse_;
  std::optional<engine::Orbit> before_tour_;
  glm::ivec2 fitted_{0};     // the scene's size that camera_ suits
  std::string shown_scene_;  // the one that camera_ was set up for
  PictureKey drawn_;         // what the canvas shows
  Pacer pacer_;
  double seconds_ = 0;  // the demo has been open
  double renewed_ = now() - shortest_screen;
};

}  // namespace

int run_demo(const DemoOptions& options) {
  Demo(options).run();
  return 0;
}

}  // namespace app

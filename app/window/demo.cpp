#include "app/window/demo.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <iterator>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

#include "app/base/background.h"
#include "app/base/timings.h"
#include "app/session/system_files.h"
#include "app/ui/state/shortcuts.h"
#include "app/ui/user_interface.h"
#include "app/ui/views/scene_labels.h"
#include "app/window/graphics.h"
#include "app/window/picture_schedule.h"
#include "app/window/preferences.h"
#include "app/window/scene_mouse.h"
#include "app/window/scene_picture.h"
#include "engine/context.h"
#include "engine/gl.h"
#include "engine/run_loop.h"

namespace app::window {
namespace {

/// Returns the session that the options ask for. A large mesh takes long to bring into equilibrium: the window shows
/// the time meanwhile, and closing it ends the program. Throws softbody::SceneError if the scene cannot be simulated.
std::unique_ptr<Session> open_session(const DemoOptions& options, Graphics& graphics) {
  std::unique_ptr<Session> session;
  const auto open = [&] {
    session = std::make_unique<Session>(options.opened, options.scene_folder, options.threads, options.scene_name);
  };
  const auto show_time = [&, began = now()] {
    if (now() - began < 0.3) return;
    graphics.window.poll();
    if (!graphics.window.is_open()) std::quick_exit(EXIT_SUCCESS);  // there is nothing to lose yet
    if (graphics.window.minimised()) return;
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
  };
  call_beside(open, std::chrono::milliseconds(30), show_time);
  while (graphics.window.has_pending_input())
    graphics.window.take_input();  // the remaining input is not for the session either
  return session;
}

class Demo {
 public:
  explicit Demo(const DemoOptions& options)
      : preferences_(session::preferences_path()),
        graphics_(std::make_unique<Graphics>(options.size.value_or(preferences_.stored().size), options.threads)),
        session_owner_(open_session(options, *graphics_)),
        session_(*session_owner_) {
    for (const std::shared_ptr<guest::Guest>& guest : options.guests) session_.guests.add(guest);
    session_.settings.set_integrator(options.integrator);
    if (options.beside) session_.simulation.set_beside(*options.beside);
    apply(preferences_.is_new() ? first_preferences(window_size()) : preferences_.stored(), session_, ui_);
    if (!options.guests.empty()) ui_.lower = ui::LowerView::comparison;
    ui_.story = ui_.story_at_start && !options.scene_given && options.meshes.empty();
    store_preferences();
    if (!options.meshes.empty() && !options.scene_given) session_.import.lone_options = options.apply;
    for (const std::string& mesh : options.meshes)  // each for itself: no frames
      session_.import.drop({mesh}, options.scene_given);
  }

  /// Handles what has happened, and draws a picture if something has changed. Returns false after the last time.
  bool turn() {
    if (!graphics_->window.is_open() || quits_) {
      finish();
      return false;
    }
    const double wait = schedule_.wait(now(), session_.awaits_answer());
    if (graphics_->window.poll(wait)) schedule_.input(now());
    const double elapsed = timer_.tick();
    const bool was_hidden = std::exchange(hidden_, graphics_->window.minimised());
    if (hidden_) return true;  // poll() has slept; the world waits until the window is shown
    if (was_hidden) schedule_.input(now());
    const bool interrupted = was_hidden || wait > PictureSchedule::max_running_wait;
    waited_ = interrupted || wait > 0;
    draw_or_wait(elapsed, interrupted);
    return true;
  }

 private:
  void finish() {
    store_preferences(true);
    // A search for a mesh's equilibrium could keep the program running for minutes after its window is closed.
    const session::Exporter& exporter = session_.exporter;
    if (session_.import.busy() && !exporter.recording() && !exporter.finishing()) std::quick_exit(EXIT_SUCCESS);
  }

  /// Draws a picture if something has changed. After an interruption the world, the camera and the tooltips go on as if
  /// no time had passed; hints and notices age.
  void draw_or_wait(double elapsed, bool interrupted) {
    const double moving = interrupted ? std::min(elapsed, 1.0 / 60) : elapsed;
    seconds_ += elapsed - moving;
    if (interrupted) session_.let_pass(elapsed - moving);
    if (schedule_.due(now()) || session_.news() != shown_ || graphics_->window.context_lost()) return draw(moving);
    seconds_ += moving;
    session_.let_pass(moving);
    store_preferences();
  }

  void draw(double elapsed) {
    if (graphics_->window.context_lost()) recreate_graphics();
    try {
      draw_picture(elapsed);
    } catch (const std::runtime_error&) {  // calls fail in a lost context; the next picture has another
      if (!graphics_->window.context_lost()) throw;
      recreate_graphics();
    }
  }

  /// Makes a new window for the same world. Throws engine::ContextError if that fails, or if the last one was lost
  /// soon.
  void recreate_graphics() {
    store_preferences(true);
    if (now() - recreated_at_ < min_context_seconds)
      throw engine::ContextError(
          "the graphics driver was reset again and again: update it, or set LIBGL_ALWAYS_SOFTWARE=1");
    const glm::ivec2 size = window_size();
    graphics_->window.wait_for_context_reset();
    graphics_.reset();  // one window at a time
    graphics_ = std::make_unique<Graphics>(size, session_.simulation.threads);
    drawn_.reset();
    recreated_at_ = now();
    session_.simulation.notice.set("the graphics driver was reset: the window was made anew, nothing else was lost");
  }

  /// Returns what the keys ask for that were pressed.
  ui::Requests requests_by_keys() {
    ui::Requests requests;
    for (const engine::KeyPress& key : graphics_->gui.take_key_presses()) {
      std::optional<ui::Request> request = ui::request_by_key(session_, key.key, key.repeat, key.mods);
      if (!request) request = ui::request_by_key(session_, key.fallback_key, key.repeat, key.mods);
      if (request) requests.push_back(std::move(*request));
    }
    return requests;
  }

  /// Begins a frame of the Gui and handles the input of mouse and keyboard.
  void handle_input(double elapsed) {
    graphics_->gui.begin_frame();
    std::vector<ui::WindowTask> tasks;
    const auto carry_out = [&](const ui::Requests& requests) {
      std::ranges::copy(ui::carry_out(requests, session_, ui_), std::back_inserter(tasks));
    };
    carry_out(requests_by_keys());
    carry_out(interface_.draw(session_, ui_, graphics_->gui.scale()));
    const engine::Viewport viewport = scene_viewport();
    carry_out(move_by_mouse(viewport));
    follow_tour();
    for (const ui::WindowTask task : tasks) perform(task, viewport.size);
    camera_.advance(elapsed);
  }

  void draw_picture(double elapsed) {
    seconds_ += elapsed;
    session_.import.drop(session_.guests.take_from(graphics_->window.take_dropped_files()));
    session_.import.update();
    // Handles all waiting input before this picture, a click at a time, so that a slow world does not delay typing and
    // clicks.
    handle_input(elapsed);
    if (const auto joined = session_.import.take_joined())  // once the scene's camera is set up
      camera_.glide_back_to_show(glm::vec3(joined->centre), joined_margin * static_cast<float>(joined->radius),
                                 scene_viewport().size);
    while (graphics_->window.has_pending_input()) {
      graphics_->gui.end_frame();
      handle_input(0);
    }
    const engine::Viewport viewport = scene_viewport();
    const ScenePicture scene = scene_picture(session_, ui_, camera_, pixel_scale());
    bool moving = false;
    double drawing_ms = time_ms([&] { moving = draw_scene(scene, viewport); });
    for (const HalfPicture& half : halves(scene, viewport))
      ui::draw_labels(scene_labels(session_, ui_.tour, scene, half.half), half.camera, half.viewport.size,
                      area_of(half.viewport), graphics_->gui.scale());
    ui_.view = render::SceneView::view(camera_, viewport.size);
    graphics_->gui.end_frame();
    const session::News before = std::exchange(shown_, session_.news());
    const bool has_news = before != shown_;
    session_.exporter.frame([this](bool with_panel, const std::optional<glm::uvec2>& size) {
      return size ? picture_of(glm::ivec2(*size)) : picture(with_panel);
    });
    if (!quits_) advance(elapsed);  // while the driver draws
    drawing_ms += time_ms([&] { present(viewport); });
    graphics_->canvas.add_timing(elapsed, 1e-3 * drawing_ms);
    store_preferences();
    const Activity next = activity(moving, has_news);
    ui_.picture_interval = seconds_to_next_picture(next);
    schedule_.drawn(now(), next);
  }

  /// Returns what goes on after the picture that was just drawn. has_news: of the interface, whose windows take another
  /// picture to fit their contents.
  Activity activity(bool moving, bool has_news) const {
    return {.moving = moving || session_.exporter.recording() || ImGui::IsAnyMouseDown(),
            .counting =
                !session_.simulation.stands_still() || (ui_.lower == ui::LowerView::sweep && session_.sweep().running),
            .reporting = session_.import.busy() || session_.exporter.finishing(),
            .typing = graphics_->gui.wants_keyboard(),
            .has_news = has_news};
  }

  /// Takes long steps beside the window. Meanwhile the camera can move; clicks and keys wait for the next picture.
  void advance(double elapsed) {
    if (session_.simulation.step_ms() < long_step_ms) return session_.advance(elapsed, waited_);
    present(scene_viewport());
    call_beside([&] { session_.advance(elapsed, waited_); }, std::chrono::milliseconds(10),
                [&, last = now()]() mutable { move_camera_only(now() - std::exchange(last, now())); });
  }

  /// Moves the camera and draws the last picture's bodies again. Uses nothing that a step writes.
  void move_camera_only(double elapsed) {
    if (graphics_->window.poll()) schedule_.input(now());
    const engine::Viewport viewport = scene_viewport();
    if (!drawn_ || graphics_->window.minimised() || viewport.size.x <= 0 || viewport.size.y <= 0) return;
    if (graphics_->window.left_button_down())
      mouse_.orbit_between_pictures(graphics_->window.cursor() - top_left(viewport), camera_, viewport.size);
    camera_.advance(elapsed);
    if (camera_ == std::exchange(drawn_->camera, camera_)) return;
    graphics_->canvas.update(viewport.size, true, false, [&](const engine::Viewport& whole) {
      for (const HalfPicture& half : halves(*drawn_, whole))
        view_of(half).redraw(half.camera, half.viewport, pixel_scale(whole, viewport));
    });
    present(viewport);
  }

  void present(const engine::Viewport& viewport) const {
    compose(viewport);
    graphics_->window.present();
  }

  /// Puts the window's picture together from the scene and the user interface.
  void compose(const engine::Viewport& viewport) const {
    graphics_->clear();
    if (viewport.size.x > 0 && viewport.size.y > 0) graphics_->canvas.show(viewport.origin);
    graphics_->gui.draw();
  }

  /// Returns the picture that is about to be shown.
  engine::Image picture(bool with_panel) const {
    if (!with_panel) return graphics_->canvas.read();
    compose(scene_viewport());
    return engine::read_pixels(0, graphics_->window.framebuffer_size());
  }

  /// Draws the scene in another size, with what the camera frames.
  engine::Image picture_of(glm::ivec2 size) {
    const engine::Viewport shown = scene_viewport(), whole{{0, 0}, size};
    ScenePicture scene = scene_picture(session_, ui_, camera_, pixel_scale());
    render::SceneView::refit(scene.camera, glm::max(shown.size, 1), size);
    if (shown.size.y > 0) scene.scale = pixel_scale(whole, shown);
    const engine::Framebuffer target(size);
    target.bind();
    draw_world(scene, whole);
    engine::Image image = target.read();
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
    return image;
  }

  void draw_world(const ScenePicture& scene, const engine::Viewport& whole) {
    for (const HalfPicture& half : halves(scene, whole))
      view_of(half).draw(session_.simulation.world(half.half), overlay_request(session_, ui_.tour, scene, half.half),
                         half.camera, half.viewport, scene.scale, drawn_meshes(session_, scene.between, half.half));
  }

  render::SceneView& view_of(const HalfPicture& half) const {
    return graphics_->views[static_cast<std::size_t>(half.half)];
  }

  /// Returns the size that the window would have on a screen of ordinary density.
  glm::ivec2 window_size() const {
    return glm::ivec2(glm::round(glm::vec2(graphics_->window.framebuffer_size()) / graphics_->window.content_scale()));
  }

  void store_preferences(bool last = false) {
    const std::string problem = preferences_.store(preferences_of(session_, ui_, window_size()), seconds_, last);
    if (!problem.empty()) session_.simulation.notice.set(problem);
  }

  engine::Viewport scene_viewport() const {
    const ImVec2 ratio = ImGui::GetIO().DisplayFramebufferScale;
    const ui::ScreenRect area = interface_.scene_area();
    const auto pixels = [](float at, float factor) { return static_cast<int>(std::lround(at * factor)); };
    const glm::ivec2 lo(pixels(area.min.x, ratio.x), pixels(area.min.y, ratio.y));
    const glm::ivec2 hi(pixels(area.max.x, ratio.x), pixels(area.max.y, ratio.y));
    return {{lo.x, graphics_->window.framebuffer_size().y - hi.y}, glm::max(hi - lo, 0)};
  }

  /// Returns a part of the window in ImGui units. `part`: pixels from the lower left corner.
  ui::ScreenRect area_of(const engine::Viewport& part) const {
    const ImVec2 ratio = ImGui::GetIO().DisplayFramebufferScale;
    const glm::vec2 low(part.origin), size(part.size);
    const float top = static_cast<float>(graphics_->window.framebuffer_size().y) - low.y - size.y;
    return {{low.x / ratio.x, top / ratio.y}, {(low.x + size.x) / ratio.x, (top + size.y) / ratio.y}};
  }

  /// Begins with the scene's own camera, and moves it by the mouse. Returns what the mouse asks for.
  ui::Requests move_by_mouse(const engine::Viewport& viewport) {
    if (shown_scene_ != session_.world().scene().key) {
      shown_scene_ = session_.world().scene().key;
      reset_camera(viewport.size);
    }
    refit(viewport.size);
    const MouseInput input = read_mouse(top_left(viewport), !graphics_->gui.wants_mouse());
    ui::Requests requests = mouse_.update(input, session_, ui_, camera_, viewport.size);
    if (mouse_.can_drag()) ImGui::SetMouseCursor(ImGuiMouseCursor_Hand);
    return requests;
  }

  void reset_camera(glm::ivec2 size) {
    camera_ = graphics_->views[0].camera(session_.world(), size);
    fitted_ = size;
    orbit_before_tour_.reset();
  }

  /// Keeps the extent of what the camera shows when the size of the scene's area changes. The tour frames it itself.
  void refit(glm::ivec2 size) {
    if (ui_.tour.open() || orbit_before_tour_ || size.x <= 0 || size.y <= 0) return;
    if (fitted_.x > 0 && fitted_ != size) render::SceneView::refit(camera_, fitted_, size);
    fitted_ = size;
  }

  /// Remembers the camera before the tour, and moves it back when the tour is closed.
  void follow_tour() {
    if (ui_.tour.open() && !orbit_before_tour_) orbit_before_tour_ = camera_.orbit();
    if (!ui_.tour.open() && orbit_before_tour_) camera_.glide_to(*std::exchange(orbit_before_tour_, std::nullopt));
  }

  /// Returns the viewport's top left corner in pixels from the window's top left corner.
  glm::vec2 top_left(const engine::Viewport& viewport) const {
    return {viewport.origin.x, graphics_->window.framebuffer_size().y - viewport.origin.y - viewport.size.y};
  }

  void perform(ui::WindowTask task, glm::ivec2 size) {
    using Task = ui::WindowTask;
    const auto& selected = session_.bodies.selected();
    const render::Highlight* highlight = ui_.tour.highlight();
    if (task == Task::quit) quits_ = true;
    if (task == Task::reset_camera) reset_camera(size);
    if (task == Task::show_selected_body && selected) focus_on(*selected, session_, camera_, size);
    if (task == Task::throw_body) throw_body(size);
    if (task == Task::switch_hold) switch_hold(size);
    if (task == Task::show_highlight && highlight)
      camera_.glide_to(highlight->centre, tour_radius_factor * highlight->radius, size);
    if (task == Task::show_as_before_tour && orbit_before_tour_) camera_.glide_to(*orbit_before_tour_);
    if (task == Task::show_first_missed || task == Task::show_first_false)
      show_wrong_pair(task == Task::show_first_missed, size);
  }

  void show_wrong_pair(bool missed, glm::ivec2 size) {
    const compare::CompareRow* row = session_.comparison.scored_row(session_.comparison.choice.misses_of);
    if (row && missed && !row->missed.empty()) return focus_on(row->missed.front(), session_, camera_, size);
    if (row && !missed && row->first_false) return focus_on(*row->first_false, session_, camera_, size);
    session_.simulation.notice.tell("in this frame no such pair is wrong: go on, and click again");
  }

  void throw_body(glm::ivec2 size) {
    const engine::Ray ray = mouse_.ray(camera_, size);
    const session::Half half = mouse_.half();
    const float distance =
        render::distance_to_scene(ray, session_.simulation.world(half), positions_under_mouse(session_, half))
            .value_or(camera_.orbit().distance);
    session_.bodies.throw_body(glm::dvec3(ray.origin), glm::dvec3(ray.origin + distance * ray.direction));
  }

  /// Holds, or lets go of, the vertex nearest to the point under the mouse, if that is the selected body's.
  void switch_hold(glm::ivec2 size) {
    const session::Half half = mouse_.half();
    const auto under =
        render::pick(mouse_.ray(camera_, size), session_.simulation.world(half), positions_under_mouse(session_, half));
    if (!under || under->body != session_.bodies.selected())
      return session_.simulation.notice.set("click a body first, then point at one of its vertices");
    const glm::vec3& w = under->weights;
    session_.bodies.switch_hold(under->corners[w.x >= w.y && w.x >= w.z ? 0 : w.y >= w.z ? 1 : 2]);
  }

  /// Draws the scene if its picture has changed. Returns true if it has, or if the bodies move.
  bool draw_scene(const ScenePicture& scene, const engine::Viewport& viewport) {
    if (viewport.size.x <= 0 || viewport.size.y <= 0) return false;
    const bool changed = drawn_ != scene;
    const bool moving = changed || moves(session_.simulation);
    const bool fine = !moving || session_.exporter.wants_shown_picture();
    graphics_->canvas.update(viewport.size, changed, fine, [&](const engine::Viewport& whole) {
      ScenePicture stretched = scene;
      stretched.scale = pixel_scale(whole, viewport);
      draw_world(stretched, whole);
    });
    ui_.render_scale = graphics_->canvas.render_scale();
    drawn_ = scene;
    return moving;
  }

  float pixel_scale() const { return std::max(graphics_->window.content_scale(), graphics_->window.pixel_ratio()); }
  /// Returns the scale in a picture `whole` that is stretched to the viewport.
  float pixel_scale(const engine::Viewport& whole, const engine::Viewport& viewport) const {
    return pixel_scale() * static_cast<float>(whole.size.y) / static_cast<float>(viewport.size.y);
  }

  static constexpr float joined_margin = 1.25f;      // of the radius of an imported body
  static constexpr float tour_radius_factor = 0.6f;  // glide_to() leaves half of the picture free, the tour less
  static constexpr double min_context_seconds = 10;  // between two losses
  static constexpr double long_step_ms = 50;

  PreferencesFile preferences_;
  std::unique_ptr<Graphics> graphics_;
  std::unique_ptr<Session> session_owner_;
  Session& session_;
  ui::UserInterface interface_;
  ui::UiState ui_;
  engine::Camera camera_;
  SceneMouse mouse_;
  std::optional<engine::Orbit> orbit_before_tour_;
  glm::ivec2 fitted_{0};               // the viewport's size that camera_ is fitted to
  std::string shown_scene_;            // that camera_ was set up for
  std::optional<ScenePicture> drawn_;  // what the canvas shows
  session::News shown_;                // by the interface, in the last picture
  bool hidden_ = false, quits_ = false;
  bool waited_ = false;  // for events, on purpose, before the present picture
  PictureTimer timer_;
  PictureSchedule schedule_{now()};
  double seconds_ = 0;  // since the window opened
  double recreated_at_ = now() - min_context_seconds;
};

}  // namespace

void run_demo(const DemoOptions& options) {
  engine::run_loop([demo = std::make_shared<Demo>(options)] { return demo->turn(); });
}

}  // namespace app::window

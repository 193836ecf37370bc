#pragma once
// The demo's state, without window, drawing or panel: a world, the time that drives it, and what is known about it.

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>

#include "app/base/time_series.h"
#include "app/compare/drawn_positions.h"
#include "app/compare/table_contents.h"
#include "app/session/compare_worker.h"
#include "app/session/ghost.h"
#include "app/session/scene_file.h"
#include "app/session/solid_list.h"
#include "app/session/stability_monitor.h"
#include "app/session/surface_monitor.h"
#include "collide/methods/detectors.h"
#include "softbody/snapshot.h"

namespace app {

struct SceneChoice {
  std::string key, name, look_at;
};

struct History {
  TimeSeries frame_ms;  // real time from one advance() to the next
  TimeSeries detect_ms, solve_ms, contacts, recall;
  TimeSeries ghost;  // distance(), in radii
  std::vector<TimeSeries> method_ms =
      std::vector<TimeSeries>(collide::method_table().size());  // of the comparison, by method
  void clear() { *this = {}; }
};

/// What to compare with the driving method, which is compared with the reference in any case.
struct CompareChoice {
  bool on = false;
  std::vector<bool> methods = std::vector<bool>(collide::method_table().size(), true);
  std::optional<std::size_t> misses_of;  // whose missed contacts to show; none: the driver's
};

inline constexpr int many_drops = 20;  // bodies

class Session {
 public:
  static constexpr double longest_elapsed = 0.5;  // s of real time that one advance() looks at; the rest is dropped
  static constexpr int most_steps = 15;           // of one advance()
  // No further step is begun in one advance() after this much, or this part of the time between pictures.
  static constexpr double step_budget_ms = 25, step_budget_part = 0.4;
  static constexpr double slowest = 0.02, fastest = 1.0;

  /// scene_folder: where other scenes are found by their keys. scene_name: what the scene is found by, if not by its
  /// key. Throws SceneError.
  Session(softbody::Scene scene, std::filesystem::path scene_folder, int threads, std::string scene_name = "");

  // Time. The world moves in whole frames; advance() is told how much real time has passed.
  bool paused = false;
  bool slow_motion = false;
  double slow_factor = 0.1;  // slowest .. fastest, of real time, in slow motion
  void advance(double elapsed);
  /// For recordings, in place of advance(): one step, however long it took, or none.
  void advance_one(double elapsed, bool step);
  /// Pauses and does one step with the next advance().
  void single_step();
  /// Simulated over asked-for time, of the last half second: below 1 time is dropped, as the machine does not
  /// keep up or frames are cut short.
  double pace() const { return pace_; }
  /// How long the last step took, the ghost's with it.
  double step_ms() const;

  /// How far a picture is on the way from the positions before the last step to the present ones, 0 .. 1: below 1 only
  /// in slow motion, which would jerk otherwise.
  float between() const;
  const Positions& before_last_step() const { return before_last_step_; }
  /// `whole_steps`: without anything between.
  DrawnPositions drawn_positions(bool whole_steps = false) const;

  // What is in the world.
  const softbody::World& world() const { return *world_; }
  const std::vector<SceneChoice>& scenes() const { return scenes_; }
  /// Loads another scene with its own settings; on an error the present one stays and notice() says why.
  void choose_scene(const std::string& key_or_path);
  /// The same with a world of that scene, which was made elsewhere with so many threads(). Throws what
  /// std::filesystem::absolute() does, and changes nothing then.
  void enter(std::unique_ptr<softbody::World> world, softbody::Scene scene, const std::string& key_or_path);
  int threads() const { return threads_; }
  /// The scene from its start, with the settings in use and without added bodies.
  void reset();
  /// The scene with the settings in use: what reset() starts.
  softbody::Scene scene_in_use() const;
  /// With the added bodies, too, each in the frame in which it came.
  softbody::Scene scene_as_it_is() const;
  /// Writes scene_as_it_is(), seen like this, to a file, which scene_file() is from then on; on an error nothing is
  /// written and notice() says why.
  void save_scene(const std::filesystem::path& file, const softbody::View& view);
  /// Where the scene came from, or was saved to last.
  const SceneFile& scene_file() const { return scene_file_; }
  /// Method and settings as the scene has them.
  void restore_settings();
  /// A body joins the world. If there is such a material already, but for its name, it has that one; else the scene
  /// gets it. On an error no body joins and notice() says why.
  void add_body(softbody::BodySource body, softbody::Material material);
  /// The world as it was before the last reset, choice of scene or deletion, to the bit; of the last few of them.
  bool can_undo() const { return !past_.empty(); }
  void undo();

  // By hand. What a world refuses is told by notice(), and nothing changes.
  static constexpr double least_throw = 1, most_throw = 25;  // m/s
  double throw_speed = 8;                                    // m/s
  bool can_drop() const { return world_->scene().dropper || !world_->scene().bodies.empty(); }
  void drop(int count = 1);
  /// direction: of length 1.
  void throw_body(const glm::dvec3& eye, const glm::dvec3& direction);
  const std::optional<softbody::BodyId>& selected_body() const { return selected_body_; }
  void select_body(std::optional<softbody::BodyId> body);
  void remove_selected();
  void grab(const softbody::Grab& grab);
  void pull_to(const glm::dvec3& target);
  void release();
  /// In m/s^2, along the direction of the scene's gravity; down, if it has none.
  void set_gravity(double strength);
  void set_material(std::size_t index, const softbody::Material& material);
  const SolidList& solids() const { return solids_; }
  void set_solids(const SolidList& solids);
  /// Gravity, materials and solids as the scene has them.
  void restore_world_settings();
  /// The scene's sentence for this moment, or empty.
  const std::string& caption() const;

  /// Pauses when the world blows up.
  bool pause_on_blow_up = true;
  const StabilityMonitor& stability() const { return stability_; }
  /// Back to the last snapshot of stability().past() not after this frame, and pauses. The settings in use stay.
  void rewind_to(int frame);

  /// A second world that goes on from the present state by another integrator, or none. It begins anew whenever hands
  /// or settings change the one that is shown.
  void set_ghost(const std::optional<IntegratorChoice>& choice);
  const Ghost* ghost() const { return ghost_.get(); }

  // Detection. Settings with a problem() are refused with a notice(), and nothing changes.
  void set_method(std::string_view key);
  void next_method();
  void set_contact_surface(softbody::ContactSurface surface);
  void next_contact_surface();
  /// substeps: of the integrator's a frame; none: as many as stability asks for.
  void set_integrator(std::string_view key, std::optional<int> substeps);
  IntegratorChoice integrator() const { return {std::string(world_->integrator().key), world_->substeps()}; }
  void set_collision(const collide::Settings& settings, bool default_cell_size);
  /// The bucket whose boxes the scene shows: always below the number of buckets.
  const std::optional<std::uint32_t>& selected_bucket() const { return selected_bucket_; }
  void select_bucket(std::optional<std::uint32_t> bucket);
  /// What it holds on the current positions; nullptr if none is selected, or its table is not known.
  const BucketContents* bucket() const;
  /// The cell of that bucket from which true sharing is seen: the one chosen, or else the fullest.
  void select_cell(const Cell& cell) { selected_cell_ = cell; }
  const std::optional<Cell>& selected_cell() const { return selected_cell_; }
  const TableContents& table() const;
  /// The method whose boxes, cells and buckets are shown: the driving one if it has a hash table, else the paper's.
  const collide::Method& shown_method() const;
  /// They themselves on the current positions, computed once a state when first asked for.
  const collide::DebugGeometry& debug() const;
  /// Those of the paper's method, whichever drives. Empty while more bodies move than can be looked at for each
  /// picture.
  const collide::DebugGeometry& paper() const;

  /// Where the exact method looks for contacts on the current positions, if nothing is known from earlier frames.
  std::vector<collide::DebugGeometry::Box> areas() const;

  // Comparison, by a worker of its own: a few frames old, and its vertices still exist.
  CompareChoice compare;
  const CompareReport& comparison() const { return comparison_; }
  /// Counts the reports, so that a new one is noticed.
  std::uint64_t comparisons() const { return comparisons_; }
  /// The index of the driving method, and its row: nullptr until it is measured, or if it cannot be.
  std::size_t driver() const { return method_index(world_->method().key); }
  const CompareRow* driver_row() const;
  /// The index in collide::method_table() of the method whose missed contacts are shown.
  std::size_t misses_of() const { return compare.on ? compare.misses_of.value_or(driver()) : driver(); }
  /// What the method of choice missed; nullptr if that is not known.
  const std::vector<collide::Contact>* missed() const;

  bool judges_surfaces = false;
  /// What the surface oracle says of the last step, while judges_surfaces is true.
  const SurfaceMonitor& surfaces() const { return surfaces_; }
  /// What pressed on what in the last step; empty unless the contact surface is the surfaces.
  const std::vector<softbody::SurfaceTouch>& touches() const;

  const History& history() const { return history_; }
  /// Changes whenever anything about the positions or contacts may have changed: not with steps of a world at rest.
  std::uint64_t revision() const { return revision_; }
  /// What went wrong last, for the user; empty again after the next successful action.
  const std::string& notice() const { return notice_; }
  void set_notice(std::string text) { notice_ = std::move(text); }
  /// What notice() begins with where no user could have caused it.
  static constexpr std::string_view defect = "not enough memory, or a defect of this program: ";

 private:
  /// A world that was left, or the present one as it was; and its scene as it was loaded.
  struct Past {
    std::unique_ptr<softbody::World> world;
    std::optional<softbody::Snapshot> snapshot;
    softbody::Scene scene;
    SceneFile file;
    SolidList solids;
  };
  static constexpr std::size_t most_past = 8;
  static constexpr std::uint64_t most_work =
      1'000'000'000;  // pair tests of a frame in the window's thread: about half a second
  template <class Value>
  struct OfRevision {
    std::uint64_t revision = 0;
    Value value{};
  };

  void start(const softbody::Scene& scene, const IntegratorChoice& integrator);
  void leave_for(std::unique_ptr<softbody::World> world);
  void show_anew();
  /// The world was restored to what it was.
  void restore(const softbody::Snapshot& snapshot);
  void went_back();
  void follow();
  void age_notice(double elapsed);
  void keep_world_settings(const softbody::Scene& in_use);
  void adopt(softbody::Scene scene);
  void remember(Past past);
  Past as_it_is() const;
  void begin();
  void run(double elapsed);
  void step();
  /// False if it failed, as notice() says: a refusal changes nothing, all else (a detector's memory, say) pauses.
  bool succeeds(const std::function<void()>& change);
  /// For what a world may refuse: then it is as before, and goes on.
  void try_change(const std::function<void()>& change);
  bool affordable(const collide::Method& method, const collide::Settings& settings);
  WorkEstimate work_of(const collide::Method& method, const collide::Settings& settings) const;
  /// How long those who work beside the demo rest, in times of their work: longer while the pictures come late.
  int rests() const;
  void exchange_comparison();
  void keep(CompareReport report);
  FrameSnapshot snapshot() const;
  void forget_measurements();
  void follow_pace(double asked, double done);
  void intervened();
  void restart_ghost();
  void step_ghost();

  std::filesystem::path scene_folder_;
  std::vector<SceneChoice> scenes_;
  int threads_;
  softbody::Scene scene_;  // as it was loaded: the world's own has the settings in use
  SceneFile scene_file_;
  std::unique_ptr<softbody::World> world_;
  std::vector<Past> past_;  // the latest last
  std::optional<softbody::BodyId> selected_body_;
  SolidList solids_;
  bool as_scripted_ = true;  // no hand has touched a body since the scene began
  Positions before_last_step_;
  double accumulator_ = 0;  // s of simulated time owed, less than one frame after advance()
  bool step_once_ = false;
  double pace_ = 1, asked_ = 0, done_ = 0;  // s within the window of follow_pace()
  std::uint64_t revision_ = 1, offered_ = 0, first_comparable_ = 0;
  std::uint64_t worlds_ = 0, comparisons_ = 0;
  std::optional<std::uint32_t> selected_bucket_;
  std::optional<Cell> selected_cell_;
  std::unique_ptr<collide::Detector> exact_;  // shows its areas
  mutable collide::methods::PaperStructure paper_structure_ = collide::methods::make_paper_structure();
  // What is shown of the state, each with the revision that it belongs to.
  mutable OfRevision<collide::DebugGeometry> debug_, paper_;
  mutable OfRevision<TableContents> table_;
  mutable OfRevision<BucketContents> bucket_;
  History history_;
  CompareReport comparison_;
  mutable std::vector<softbody::SurfaceTouch> touches_;
  mutable std::uint64_t touches_revision_ = 0;
  std::string notice_, aged_notice_;
  double notice_age_ = 0;  // s, of aged_notice_
  CompareWorker compare_worker_;
  SurfaceMonitor surfaces_;
  StabilityMonitor stability_;
  std::unique_ptr<Ghost> ghost_;
};

}  // namespace app

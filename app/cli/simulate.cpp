#include "app/cli/commands.h"

#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <iostream>
#include <iterator>
#include <set>
#include <utility>

#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include "app/base/streams.h"
#include "app/compare/blow_up_monitor.h"
#include "app/compare/run_figures.h"
#include "app/compare/world_oracle.h"
#include "app/files/inputs.h"
#include "app/files/obj_writer.h"
#include "app/files/output_file.h"
#include "softbody/world/measures.h"
#if SBCOLLIDE_GRAPHICS
#include "app/render/animation.h"
#include "app/render/capture.h"
#endif

namespace app::cli {
namespace {

using Json = nlohmann::ordered_json;

/// The figures of one frame.
struct FrameRow {
  int frame;
  softbody::StepReport step;
  std::uint64_t bodies, self, solid;  // contacts
  softbody::Measures measures;
  std::optional<collide::oracle::SurfaceFigures> oracle{};  // on request
};

Json to_json(const collide::oracle::SurfaceFigures& f) {
  return {{"penetrating_vertices", f.penetrating_vertices},
          {"overlapping_pairs", f.overlapping_pairs},
          {"self_intersecting_bodies", f.self_intersecting_bodies},
          {"deepest", f.deepest},
          {"mean_depth", f.mean_depth},
          {"crossed_vertices", f.crossed_vertices},
          {"edge_crossings", f.edge_crossings}};
}

Json to_json(const FrameRow& r) {
  const softbody::Measures& m = r.measures;
  const auto ratio = [&](double value) { return m.has_volume ? Json(value) : Json(nullptr); };
  Json row{{"frame", r.frame},
           {"time", r.step.time},
           {"ms", {{"detect", r.step.detect_ms}, {"solve", r.step.solve_ms}, {"total", r.step.total_ms}}},
           {"contacts", {{"bodies", r.bodies}, {"self", r.self}, {"solid", r.solid}}},
           {"energy", m.energy},
           {"energies",
            {{"kinetic", m.energies.kinetic},
             {"elastic", m.energies.elastic},
             {"gas", m.energies.gas},
             {"gravity", m.energies.gravity}}},
           {"volume_ratio", {{"min", ratio(m.volume_ratio_min)}, {"max", ratio(m.volume_ratio_max)}}},
           {"deepest_penetration", m.deepest_penetration},
           {"max_speed", m.max_speed},
           {"finite", m.finite}};
  if (r.oracle) row["oracle"] = to_json(*r.oracle);
  return row;
}

Json to_json(const std::vector<softbody::Stage>& stages) {
  Json keys = Json::array();
  for (const softbody::Stage s : stages) keys.push_back(softbody::stage_key(s));
  return keys;
}

Json plan_json(const softbody::World& world) {
  const softbody::Plan& plan = world.plan();
  Json left_out = Json::array();
  for (const softbody::LeftOut& l : plan.left_out)
    left_out.push_back({{"stage", softbody::stage_key(l.stage)}, {"why", l.why}});
  Json shapes = Json::array();
  for (const softbody::ShapeTraits* shape : plan.shapes) shapes.push_back(shape->key);
  Json json{{"stages", to_json(plan.stages)}, {"shapes", shapes}, {"left_out", left_out}};
  const softbody::Integrator& integrator = world.integrator_choice().integrator();
  if (integrator.projects) json["as_forces"] = to_json(plan.unprojected(integrator));
  return json;
}

std::string hex(std::uint64_t value) { return fmt::format("{:016x}", value); }

/// Prints a line that a reader gets at once. Throws UsageError.
void print_line(const Json& object) {
  std::cout << object.dump(-1, ' ', false, Json::error_handler_t::replace) << '\n';
  flush_standard_output();
}

/// Says on standard error what has gone wrong in a run, and notes it.
void warn(std::vector<std::string>& warnings, std::string text) {
  clear_progress();
  std::fprintf(stderr, "warning: %s\n", text.c_str());
  warnings.push_back(std::move(text));
}

/// Returns the file for a result of one frame: PREFIX_0012ENDING in the folder for results, with at least four digits.
std::filesystem::path result_file(const Options& options, const char* prefix, int frame, const char* ending) {
  return options.out / fmt::format("{}_{:04}{}", prefix, frame, ending);
}

#if SBCOLLIDE_GRAPHICS
/// Writes the requested pictures and the animation.
class Pictures {
 public:
  explicit Pictures(const Options& options) : options_(options) {
    if (options.captures.empty() && !options.animation) return;
    // First: without OpenGL no folder should be made.
    capture_ = std::make_unique<render::Capture>(options.picture_size());
    if (!options.captures.empty()) files::prepare_folder(options.out);
    for (const int frame : options.captures) files::require_no_input(picture_file(frame));
    if (options.animation) animation_.emplace(*options.animation);
  }
  void take(const softbody::World& world, const softbody::World* second) {
    const int frame = world.frame();
    const bool captured = std::binary_search(options_.captures.begin(), options_.captures.end(), frame);
    const bool animated = animation_ && (frame - 1) % stride_ == 0;
    if (!captured && !animated) return;
    engine::Image picture = capture_->draw(world, second);
    if (captured) files::write_file(picture_file(frame), engine::encode_png(picture));
    if (animated) animation_->add(std::move(picture), start_of(frame));
  }
  /// Writes the animation of the whole run.
  void finish() {
    const int pictures = (options_.frames - 1) / stride_ + 1;
    if (animation_) animation_->write(start_of(1 + pictures * stride_));
  }

 private:
  std::filesystem::path picture_file(int frame) const { return result_file(options_, "frame", frame, ".png"); }
  /// Returns the time (s) at which the animation shows that frame: frame 1 at 0.
  double start_of(int frame) const { return (frame - 1) * options_.frame_time; }

  const Options& options_;
  int stride_ = frames_per_picture(options_.frame_time);
  std::unique_ptr<render::Capture> capture_;
  std::optional<render::Animation> animation_;
};
#else
/// Refuses pictures before anything runs.
class Pictures {
 public:
  explicit Pictures(const Options& options) {
    for (const auto& [option, requested] :
         {std::pair("--capture", !options.captures.empty()), std::pair("--animation", options.animation.has_value())})
      if (requested)
        throw UsageError(std::string(option) + ": this build has no graphics; configure with -DSBCOLLIDE_GRAPHICS=ON");
  }
  void take(const softbody::World&, const softbody::World*) {}
  void finish() {}
};
#endif

/// Writes the bodies of every Nth frame; at rest, with the scene around them, whenever they have changed. Leaves out
/// frames with a body that is not finite.
class ObjSequence {
 public:
  ObjSequence(const Options& options, std::vector<std::string>& warnings) : options_(options), warnings_(warnings) {
    if (!options.obj_every) return;
    files::prepare_folder(options.out);
    for (const auto& entry : std::filesystem::directory_iterator(options.out))
      if (will_write(entry.path().filename().string())) files::require_no_input(entry.path());
    files::OutputFile(options.out / files::surroundings_name, files::surroundings_heading);  // throws if it may not be
  }
  void take(const softbody::World& world) {
    if (!options_.obj_every || world.frame() % *options_.obj_every != 0) return;
    if (world.bodies().count() == 0) return;  // `detect` refuses a file without vertices
    const auto [x, y, z, bodies] = world.positions();
    if (!files::ObjWriter::can_write({x, y, z})) {
      if (!std::exchange(left_out_, true))
        warn(warnings_, file("frame", world.frame()).string() +
                            ": is not written, nor are later ones like it: a body is no longer finite");
      return;
    }
    if (!bodies_ || !bodies_->matches(world)) {
      bodies_.emplace(world);
      files::write_file(file("rest", world.frame()), bodies_->at_rest());
      bodies_->write_surroundings(options_.out);
    }
    files::write_file(file("frame", world.frame()), bodies_->frame({x, y, z}));
  }

 private:
  std::filesystem::path file(const char* prefix, int frame) const {
    return result_file(options_, prefix, frame, ".obj");
  }
  bool will_write(const std::string& name) const {
    for (const std::string prefix : {"rest", "frame"}) {
      if (!name.starts_with(prefix + "_")) continue;
      const int frame = std::atoi(name.c_str() + prefix.size() + 1);
      if (frame > 0 && frame <= options_.frames && frame % *options_.obj_every == 0 &&
          file(prefix.c_str(), frame).filename() == name)
        return true;
    }
    return false;
  }

  const Options& options_;
  std::vector<std::string>& warnings_;
  std::optional<files::ObjWriter> bodies_;
  bool left_out_ = false;  // some frame
};

/// Prints what was changed in imported meshes where this may surprise, once for each mesh.
void print_remarks(const softbody::Scene& scene) {
  std::set<const softbody::ImportedMesh*> printed;
  for (const softbody::BodySource& body : scene.bodies) {
    const softbody::ImportedMesh* mesh = body.mesh.imported.get();
    if (!mesh || !printed.insert(mesh).second) continue;
    if (const std::string text = remarks(*mesh); !text.empty())
      std::fprintf(stderr, "note: %s: %s\n", body.mesh.file.path.lexically_normal().string().c_str(), text.c_str());
  }
}

/// Names the bodies that start in solids or in each other.
void print_overlaps(const softbody::World& world) {
  const std::vector<softbody::BodyId> bodies = softbody::overlapping_bodies(world);
  if (bodies.empty()) return;
  constexpr std::size_t named = 10;
  std::string text = "warning: these bodies start in a solid or in another body, and are eased out:";
  for (std::size_t i = 0; i < std::min(bodies.size(), named); ++i) text += ' ' + std::to_string(bodies[i]);
  if (bodies.size() > named) text += " and " + std::to_string(bodies.size() - named) + " more";
  std::fprintf(stderr, "%s\n", text.c_str());
}

/// A world that runs, with the figures of its frames and what is wrong with it.
class Run {
 public:
  /// name: begins the lines of warnings.
  Run(const Options& options, compare::HowSimulated how, const char* name)
      : options_(options),
        name_(name),
        world_(std::move(how.scene),
               {.threads = options.threads, .frame_time = options.frame_time, .integrator = how.integrator}),
        oracle_(options.oracle ? options.threads : 1),
        blow_up_(monitor_.check(world_, softbody::measure_bodies(world_))) {
    if (options.oracle) oracle_.crossings(world_);  // keeps the start positions of the first frame
  }

  void step() {
    world_.step();
    if (!options_.beside.empty() && !prints_json()) figures_.add(world_);
    const std::vector<softbody::BodyMeasures> bodies = softbody::measure_bodies(world_);
    if (!blow_up_ && (blow_up_ = monitor_.check(world_, bodies)))
      warn(warnings_,
           fmt::format("{}frame {}: {}; see --integrator and --substeps", name_, blow_up_->frame, blow_up_->what));
    // A table has about twenty lines for any number of frames.
    const int stride = prints_json() ? 1 : std::max(1, options_.frames / 20);
    if (world_.frame() % stride != 0 && world_.frame() != options_.frames) return;
    const collide::Result& found = world_.detection();
    FrameRow& row = rows_.emplace_back(FrameRow{.frame = world_.frame(),
                                                .step = world_.last_step(),
                                                .bodies = found.contacts.size() - found.self_contacts,
                                                .self = found.self_contacts,
                                                .solid = softbody::solid_contacts(world_).size(),
                                                .measures = softbody::measure(world_, bodies)});
    if (options_.oracle)
      row.oracle = collide::oracle::figures_of(world_.simulated().positions, oracle_.overlaps(world_),
                                               oracle_.crossings(world_));
  }

  const softbody::World& world() const { return world_; }
  compare::HowSimulated how() const { return {world_.scene(), world_.integrator_choice()}; }
  std::vector<std::string>& warnings() { return warnings_; }
  const std::vector<FrameRow>& rows() const { return rows_; }
  void forget_rows() { rows_.clear(); }
  /// Returns the document of the run after its last frame; without frames, its other fields.
  Json document() const {
    Json document{
        {"scene", world_.scene().key},
        {"method", world_.method().key},
        {"integrator",  // the one asked for, the one that the last frame used, and why if it was chosen automatically
         {{"key", world_.integrator_choice().key},
          {"used", world_.last_step().integrator->key},
          {"why", world_.last_step().why}}},
        {"plan", plan_json(world_)},
        {"warnings", all_warnings()}};
    for (const FrameRow& r : rows_) document["frames"].push_back(to_json(r));
    document["state_hash"] = hex(world_.state_hash());
    return document;
  }

  void print() const {
    std::cout << fmt::format("{}, {}, bodies: {}, vertices: {}; contacts between bodies, inside one, with solids\n",
                             world_.scene().name, world_.method().name, world_.bodies().count(),
                             world_.bodies().vertex_count());
    for (const std::string& warning : all_warnings()) std::cout << "note: " << warning << '\n';
    std::cout << "  frame  detect ms  solve ms  between  inside   solid     energy J   V min   V max    deepest m  "
                 "speed m/s\n";
    for (const FrameRow& r : rows_) {
      const softbody::Measures& m = r.measures;
      const auto ratio = [&](double value) { return m.has_volume ? fmt::format("{:.3f}", value) : "-"; };
      std::cout << fmt::format("{:7} {:10.3f} {:9.3f} {:8} {:7} {:7} {:>12.4f} {:>7} {:>7} {:>12.2e} {:>10.4f}{}\n",
                               r.frame, r.step.detect_ms, r.step.solve_ms, r.bodies, r.self, r.solid, m.energy,
                               ratio(m.volume_ratio_min), ratio(m.volume_ratio_max), m.deepest_penetration, m.max_speed,
                               m.finite ? "" : "  NOT FINITE");
    }
    std::cout << "integrator: " << world_.last_step().integrator->name;
    if (const auto why = world_.last_step().why; !why.empty()) std::cout << ", for " << why;
    for (const softbody::Stage s : world_.plan().unprojected(world_.integrator_choice().integrator()))
      std::cout << "\n  " << softbody::stage_key(s) << " acts as a force";
    std::cout << "\nstages left out:" << (world_.plan().left_out.empty() ? " none" : "") << '\n';
    for (const softbody::LeftOut& l : world_.plan().left_out)
      std::cout << "  " << softbody::stage_key(l.stage) << ": " << l.why << '\n';
    if (const compare::RunTotals& run = figures_.totals(); run.frames > 0)
      std::cout << fmt::format("missed {} of {} contacts\n", run.missed, run.true_contacts);
    std::cout << "state hash " << hex(world_.state_hash()) << '\n';
  }

 private:
  bool prints_json() const { return options_.json || options_.json_lines; }
  /// Returns what went wrong, and what is likely to be wrong with the detector's settings, or with the contact of
  /// vertices.
  std::vector<std::string> all_warnings() const {
    std::vector<std::string> all = warnings_;
    std::ranges::copy(cli::warnings(world_.method(), world_.collision()), std::back_inserter(all));
    const double safe = softbody::safe_vertex_tolerance(world_), tolerance = double{world_.collision().tolerance};
    if (tolerance < safe)
      all.push_back(
          fmt::format("vertices can slip through faces: the tolerance is {:.2g} m, below {:.2g} m; see "
                      "--tolerance and --contact-surface",
                      tolerance, safe));
    return all;
  }

  const Options& options_;
  const char* name_;
  softbody::World world_;
  compare::WorldOracle oracle_;
  compare::BlowUpMonitor monitor_;
  std::optional<compare::BlowUp> blow_up_;
  compare::RunFigures figures_;  // of two worlds, for print()
  std::vector<std::string> warnings_;
  std::vector<FrameRow> rows_;
};

}  // namespace

void simulate(const Options& options) {
  softbody::Scene scene = open(options).scene;
  files::protect_input(softbody::scene_path(options.scene, files::scene_folder()));
  files::protect_input(softbody::presets_path(files::scene_folder()));
  files::protect_inputs(scene);
  const auto beside = second_world(options, scene);
  Run first(options, {std::move(scene), options.integrator}, "");
  std::optional<Run> second;
  if (beside) second.emplace(options, *beside, "beside: ");
  Pictures pictures(options);
  ObjSequence obj_sequence(options, first.warnings());
  if (options.out_given) files::prepare_folder(options.out);
  print_remarks(first.world().scene());
  print_overlaps(first.world());
  // Where the lines of frames go to a terminal, they show the progress themselves.
  const bool progress = !options.json_lines || !isatty(STDOUT_FILENO);
  while (first.world().frame() < options.frames) {
    first.step();
    if (second) second->step();
    pictures.take(first.world(), second ? &second->world() : nullptr);
    obj_sequence.take(first.world());
    if (options.json_lines) {
      Json line = to_json(first.rows().back());
      if (second) line["beside"] = to_json(second->rows().back());
      print_line(line);
      first.forget_rows();
      if (second) second->forget_rows();
    }
    if (progress && first.world().frame() % 10 == 0)
      show_progress(fmt::format("frame {} of {}", first.world().frame(), options.frames));
  }
  pictures.finish();
  if (progress) clear_progress();
  if (options.json_lines || options.json) {
    Json document = first.document();
    if (second) document["beside"] = second->document();
    return print_line(document);
  }
  first.print();
  if (!second) return;
  std::cout << fmt::format("\nbeside it, {}:\n", compare::Difference(first.how(), second->how()).text(second->how()));
  second->print();
}

}  // namespace app::cli

// The program: parses the command line and calls a command. All errors end here, as one line and exit status 2.

#include <cstdio>
#include <exception>
#include <new>

#include "app/base/signals.h"
#include "app/base/streams.h"
#include "app/cli/commands.h"
#include "app/files/inputs.h"
#include "app/files/output_file.h"
#include "app/guest/guest.h"
#include "app/report/report.h"
#if SBCOLLIDE_GRAPHICS
#include "app/window/demo.h"
#endif

namespace {

void run(const app::cli::Options& options) {
  using app::cli::Command;
  std::vector<std::shared_ptr<app::guest::Guest>> guests;
  for (const std::string& file : options.guests) {
    app::files::protect_input(file);
    guests.push_back(app::guest::open(file));
  }
  switch (options.command) {
    case Command::list:
      return app::cli::list(options.list_of);
    case Command::new_method:
      return app::cli::new_method(options.new_method);
    case Command::simulate:
      return app::cli::simulate(options);
    case Command::detect:
      return app::cli::detect(options);
    case Command::report:
      return app::report::report(options.report);
    case Command::demo:
      break;
  }
#if SBCOLLIDE_GRAPHICS
  app::files::Opened opened = app::cli::open(options);
  const auto beside = app::cli::second_world(options, opened.scene);
  app::window::run_demo({.opened = std::move(opened),
                         .scene_name = options.play.empty() ? options.scene : options.play.front(),
                         .scene_given = options.scene_given || !options.play.empty(),
                         .scene_folder = app::files::scene_folder(),
                         .meshes = options.meshes,
                         .guests = guests,
                         .apply = [options](softbody::Scene& scene) { app::cli::apply(options, scene); },
                         .integrator = options.integrator,
                         .beside = beside,
                         .threads = options.threads,
                         .size = options.size});
#else
  throw app::UsageError(
      "this build has no window; use `sbcollide simulate`, or configure with -DSBCOLLIDE_GRAPHICS=ON");
#endif
}

}  // namespace

int main(int argc, char** argv) {
  app::guest::run_if_guest(argc, argv);
  try {
    app::handle_signals(&app::files::remove_temporary_files);
    const auto options = app::cli::parse_options(argc, argv);
    if (options) run(*options);
    app::flush_standard_output();
    return 0;
  } catch (const std::bad_alloc&) {
    app::clear_progress();
    std::fprintf(stderr, "sbcollide: not enough memory; give it less at a time\n");
    return 2;
  } catch (const std::exception& error) {
    app::clear_progress();
    std::fprintf(stderr, "sbcollide: %s\n", error.what());
    return 2;
  }
}

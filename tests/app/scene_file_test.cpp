// Saves the running scene, and checks the commands that reproduce it.

#include <gtest/gtest.h>

#include <cstdio>

#include "app/cli/options.h"
#include "app/files/inputs.h"
#include "app/session/session.h"
#include "app/session/system_files.h"
#include "tests/app/scenes.h"
#include "tests/temporary_folder.h"

namespace app {
namespace THIS_FILE {

using tests::TemporaryFolder;

/// Returns the words into which a shell splits a command.
std::vector<std::string> words_of(const std::string& command) {
  const std::string line = "printf '%s\\0' " + command;
  FILE* shell = ::popen(line.c_str(), "r");
  std::vector<std::string> words(1);
  for (int c = std::fgetc(shell); c != EOF; c = std::fgetc(shell))
    if (c == '\0')
      words.emplace_back();
    else
      words.back() += static_cast<char>(c);
  ::pclose(shell);
  words.pop_back();
  return words;
}

/// Returns what the program reads when a shell runs the command with these words.
cli::Options parse(const std::vector<std::string>& command) {
  const std::vector<std::string> words = words_of(session::this_system().start_text(command));
  std::vector<const char*> argv;
  for (const std::string& word : words) argv.push_back(word.c_str());
  return cli::parse_options(static_cast<int>(argv.size()), argv.data()).value();
}

/// Returns the scene with settings that no shipped scene has.
softbody::Scene changed(softbody::Scene scene) {
  scene.method = "grid-hash";
  scene.contact_surface = softbody::ContactSurface::surfaces;
  scene.collision = {.tolerance = 0.123f,
                     .self_collision = false,
                     .levels = 5,
                     .buckets = 997,
                     .cell_size = glm::vec3{0.3f, 0.4f, 0.5f},
                     .primes = {3, 5, 4294967295u}};
  scene.view = {.target = {-0.5, 1.25, 1e-7}, .distance = 7.5, .azimuth = -179.5, .elevation = -12};
  return scene;
}

TEST(SceneCommands, ReproduceTheRunningScene) {
  for (const std::string& key : softbody::scene_keys(files::scene_folder())) {
    SCOPED_TRACE(key);
    const softbody::Scene scene = softbody::find_scene(key, files::scene_folder());
    for (const softbody::Scene& used : {scene, changed(scene)}) {
      const cli::Options demo = parse(session::demo_words(key, {used, {}}));
      EXPECT_EQ(demo.command, cli::Command::demo);
      softbody::Scene made = cli::open(demo).scene;
      ASSERT_EQ(made.bodies.size(), used.bodies.size());
      made.bodies = used.bodies;  // meshes from files are read anew
      made.dropper = used.dropper;
      EXPECT_TRUE(made == used);
      const cli::Options simulate = parse(session::simulate_words(session::demo_words(key, {used, {"xpbd", 7}}), 17));
      EXPECT_EQ(simulate.command, cli::Command::simulate);
      EXPECT_EQ(simulate.frames, 17);
      EXPECT_EQ(simulate.integrator, (softbody::IntegratorChoice{"xpbd", 7}));
      EXPECT_EQ(simulate.captures, std::vector{17});
      EXPECT_EQ(simulate.scene, demo.scene);
    }
  }
}

TEST(SceneCommands, ReproduceTheSecondWorld) {
  const compare::HowSimulated first{softbody::find_scene("D", files::scene_folder()), {}};
  compare::HowSimulated second = first;
  EXPECT_TRUE(parse(session::demo_words("D", first, second)).beside.empty()) << "no difference";
  second.scene.method = "multi-level-sb";
  second.scene.collision.cell_size = glm::vec3{0.3f, 0.4f, 0.5f};
  second.scene.collision.tolerance = 0.07f;
  second.scene.contact_surface = softbody::ContactSurface::surfaces;
  second.integrator.key = "xpbd";
  const std::vector<std::string> words = session::demo_words("D", first, second);
  const cli::Options options = parse(words);
  const auto made = cli::second_world(options, cli::open(options).scene);
  ASSERT_TRUE(made);
  EXPECT_EQ(compare::Difference(first, second).text(*made), compare::Difference(first, second).text(second));
  EXPECT_EQ(compare::Difference(second, *made).text(second), "the same settings");
  EXPECT_EQ(parse(session::simulate_words(words, 3)).beside.size(), 1u);
}

TEST(SceneCommands, QuoteNamesForAShell) {
  for (const std::string name :
       {"it's a \"scene\" $HOME `id`\\.toml", "a b.toml", "-x.toml", "D", "é\n*?[a].toml", "~"})
    EXPECT_EQ(parse(session::demo_words(name, {touching_pair(), {}})).scene, name);
  EXPECT_TRUE(session::this_system().start_text({"D", ""}).ends_with(" D ''"));
}

TEST(SceneCommands, ReproduceASceneSavedWithTheSettingsInUse) {
  const TemporaryFolder folder;
  Session session(touching_pair(), {}, 1);
  const auto file = folder.path() / "it's saved.toml";
  const softbody::View view = changed({}).view;
  session.simulation.change_scene("Settings", [](softbody::Scene& s) {
    s = changed(s);
    s.solids[0].enabled = false;
  });
  ASSERT_EQ(session.simulation.notice.text(), "");
  ASSERT_EQ(session.scenes.save(file, view), "");
  EXPECT_EQ(session.simulation.loaded.file.name(), file.string());
  softbody::Scene used = session.world().scene();
  used.view = view;
  EXPECT_TRUE(session::options_make(used, session.simulation.loaded.scene));
  softbody::Scene made = cli::open(parse(session::demo_words(session.simulation.loaded.file.name(), {used, {}}))).scene;
  made.key = used.key;
  EXPECT_TRUE(made == used);
  EXPECT_EQ(made.method, changed({}).method);
  EXPECT_FALSE(made.solids[0].enabled);
}

TEST(SceneCommands, ReproduceWhatOptionsCanMake) {
  const softbody::Scene named = touching_pair();
  softbody::Scene used = touching_pair();
  EXPECT_TRUE(session::options_make(used, named));
  EXPECT_TRUE(session::options_make(changed(used), named));
  used.gravity.y = -1;
  EXPECT_FALSE(session::options_make(used, named));
  used = touching_pair();
  used.bodies.pop_back();
  EXPECT_FALSE(session::options_make(used, named));
}

TEST(SaveScene, WritesAddedBodiesWithTheirFrames) {
  const TemporaryFolder folder;
  const auto file = folder.path() / "a.toml";
  Session session(softbody::find_scene("drop", files::scene_folder()), {}, 1);
  const auto go_on = [](Session& s, int frames) {
    for (int i = 0; i < frames; ++i) s.advance_one(1.0 / 60);
  };
  const auto begin = session.world().scene().bodies.size();
  session.bodies.drop(2);
  go_on(session, 40);
  session.bodies.throw_body({6, 2, 0}, {0, 2, 0});
  session.bodies.drop();
  go_on(session, 30);
  ASSERT_EQ(session.simulated()->added().size(), 4u);
  ASSERT_EQ(session.scenes.save(file, {}), "");
  EXPECT_TRUE(session::options_make(session.scenes.with_added_bodies(), session.simulation.loaded.scene));
  Session again(softbody::load_scene(file), {}, 1);
  EXPECT_EQ(again.world().scene().bodies.size(), begin + 4);
  go_on(again, 70);
  EXPECT_EQ(again.simulated()->state_hash(), session.simulated()->state_hash());
  EXPECT_TRUE(again.simulated()->added().empty());  // they are the scene's now
  session.bodies.select(session.simulated()->added()[1].body);
  session.bodies.remove_selected();
  EXPECT_EQ(session.scenes.with_added_bodies().bodies.size(), begin + 3);
  undo(session.simulation);
  EXPECT_EQ(session.scenes.with_added_bodies().bodies.size(), begin + 4);
  session.simulation.reset();
  EXPECT_EQ(session.scenes.with_added_bodies().bodies.size(), begin);
}

TEST(SaveScene, ReportsErrorsAndWritesNothing) {
  const TemporaryFolder folder;
  Session session(touching_pair(), {}, 1);
  const auto expect_problem = [&](const std::filesystem::path& file, const std::string& says) {
    const std::string problem = session.scenes.save(file, {});
    EXPECT_NE(problem.find(says), std::string::npos) << problem;
    EXPECT_EQ(session.simulation.loaded.file.name(), "pair");
  };
  expect_problem(folder.path() / "a.txt", ".toml");
  expect_problem(folder.path() / "none" / "a.toml", "cannot be written");
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
  EXPECT_FALSE(session.simulation.clock.paused);
}

TEST(SaveScene, AsksBeforeItReplacesAFileThatIsNotTheScenesOwn) {
  const TemporaryFolder folder;
  const auto file = folder.write("a.toml", "[[body]]\n"), other = folder.write("b.toml", "[[body]]\n");
  Session session(softbody::load_scene(file), {}, 1, file);
  const auto question = [&](const std::filesystem::path& path) { return session.scenes.question_before_save(path); };
  EXPECT_EQ(question(file), "");
  EXPECT_EQ(question(folder.path() / "." / "a.toml"), "") << "under another path";
  EXPECT_EQ(question(folder.path() / "new.toml"), "");
  EXPECT_EQ(question(folder.write("notes.txt", "")), "") << "save() refuses it";
  EXPECT_EQ(question(other), "b.toml exists. Replace it?");
  ASSERT_EQ(session.scenes.save(other, {}), "");
  EXPECT_EQ(question(other), "") << "it is the scene's file now";
  EXPECT_EQ(question(file), "a.toml exists. Replace it?");
  std::filesystem::last_write_time(other, std::filesystem::last_write_time(other) + std::chrono::seconds(1));
  EXPECT_EQ(question(other), "b.toml has changed since this scene was loaded or saved. Replace it?");
  ASSERT_EQ(session.scenes.save(other, {}), "");
  EXPECT_EQ(question(other), "");
}

TEST(SaveScene, ReplacesASceneFileButNoMesh) {
  const TemporaryFolder folder;
  const std::string tetrahedron = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n";
  const auto mesh = folder.write("mesh.obj", tetrahedron), added = folder.write("added.obj", tetrahedron);
  const auto file = folder.write("a.toml", "[[body]]\nmesh = {kind = \"file\", path = \"mesh.obj\", size = 1}\n");
  Session session(softbody::load_scene(file), {}, 1, file);
  session.bodies.add({.mesh = softbody::MeshSource::from_file({.path = added, .size = 1}), .position = {0, 9, 0}},
                     session.world().scene().materials[0]);
  ASSERT_EQ(session.simulation.notice.text(), "");
  for (const auto& each : {mesh, added}) {
    const auto link = each.string() + ".toml";
    std::filesystem::create_hard_link(each, link);
    const std::string problem = session.scenes.save(link, {});
    EXPECT_NE(problem.find("is the input " + each.string()), std::string::npos) << problem;
    EXPECT_TRUE(std::filesystem::equivalent(each, link));
  }
  EXPECT_EQ(session.scenes.save(file, {.distance = 3}), "");
  EXPECT_EQ(session.simulation.notice.text(), "Scene saved: " + file.string());
  EXPECT_EQ(softbody::load_scene(file).view.distance, 3);
}

}  // namespace THIS_FILE
}  // namespace app

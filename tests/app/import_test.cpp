// Import of the user's own meshes and scenes: what is added, where, and what is reported or refused.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <sstream>

#include "app/session/session.h"
#include "softbody/model/body_model.h"
#include "softbody/world/body_model_set.h"
#include "softbody/world/measures.h"
#include "tests/app/scenes.h"
#include "tests/temporary_folder.h"

namespace app {
namespace THIS_FILE {

using tests::TemporaryFolder;

struct Globe {
  int rows = 16, columns = 24;
  double scale = 1, bump = 0;  // bump: depth of the concave parts
  bool seam = false;           // duplicates the first meridian's vertices, as exporters do for texture coordinates
  bool open = false;           // without the top
};

std::string obj_of(const Globe& g) {
  std::ostringstream text;
  const int across = g.columns + (g.seam ? 1 : 0);
  for (int i = 0; i <= g.rows; ++i)
    for (int j = 0; j < across; ++j) {
      const double t = std::numbers::pi * (g.open ? 0.3 + 0.7 * i / g.rows : double(i) / g.rows);
      const double p = 2 * std::numbers::pi * (j % g.columns) / g.columns;
      const double r = g.scale * (1 + g.bump * std::sin(5 * p) * std::pow(std::sin(t), 2));
      text << "v " << r * std::sin(t) * std::cos(p) << ' ' << r * std::cos(t) << ' ' << r * std::sin(t) * std::sin(p)
           << '\n';
    }
  for (int i = 0; i < g.rows; ++i)
    for (int j = 0; j < g.columns; ++j) {
      const int a = i * across + j + 1, b = i * across + (g.seam ? j + 1 : (j + 1) % g.columns) + 1;
      text << "f " << a << ' ' << b << ' ' << b + across << ' ' << a + across << '\n';
    }
  return text.str();
}

class ImportTest : public testing::Test {
 protected:
  /// Lets a mesh join the scene.
  void join(const std::filesystem::path& file) {
    import.drop({file.string()}, true);
    wait();
  }
  void load(const std::filesystem::path& file) {
    import.path = file.string();
    import.load();
    wait();
  }
  void wait() {
    ASSERT_TRUE(wait_until([&] {
      update();
      return !import.busy();
    }));
  }
  void drop(const std::vector<std::string>& files) {
    import.drop(files);
    wait();
  }
  void update() {
    import.update();
    const auto now = import.take_joined();
    joined += now.has_value();
    if (now) place = now;
  }
  std::string report() const {
    std::string text;
    for (const session::Import::FileReport& file_report : import.report()) text += file_report.text + "\n";
    return text;
  }
  bool refused() const { return !import.report().empty() && import.report().back().refused; }
  const softbody::BodyModel& last() const { return session.world().model(session.world().bodies().count() - 1); }
  void expect_finite_after(int steps) {
    run(session, steps);
    EXPECT_TRUE(softbody::measure(*session.simulated()).finite);
  }

  TemporaryFolder folder;
  Session session{touching_pair(), {}, 1};
  session::Import& import = session.import;
  int joined = 0;                                  // meshes
  std::optional<session::Import::JoinedAt> place;  // of the last one
};

TEST_F(ImportTest, OpensAMeshAloneOnTheGroundLargeInTheMiddle) {
  run(session, 5);
  load(folder.write("ball.obj", obj_of({.scale = 7, .bump = 0.3})));
  const softbody::Scene& scene = session.world().scene();
  ASSERT_EQ(session.world().bodies().count(), 1u);
  ASSERT_EQ(scene.solids.size(), 1u);
  EXPECT_EQ(scene.name, "ball.obj");
  EXPECT_NEAR(centre(session.world(), 0).x, scene.view.target.x, 1e-6);
  EXPECT_LT(scene.view.distance, 4) << "it is 1 m large";
  EXPECT_EQ(std::ranges::count(report(), '\n'), 1) << report();
  expect_finite_after(120);
  EXPECT_LT(centre(session.world(), 0).y, 0.6) << "it has fallen";
  session.bodies.drop();
  EXPECT_EQ(session.world().bodies().count(), 2u) << "another one of its kind";
  EXPECT_EQ(&session.world().model(1), &session.world().model(0));
  undo(session.simulation);
  undo(session.simulation);
  EXPECT_EQ(session.world().scene().key, "pair");
  EXPECT_EQ(session.world().frame(), 5) << "the scene before is back";
}

TEST_F(ImportTest, SaysThatAMeshHasJoinedThoughItEndsTheSecondHalf) {
  session.simulation.set_beside(compare::HowSimulated{session.world().scene(), {"implicit", {}}});
  ASSERT_TRUE(session.simulation.beside());
  import.resolution = 1500;
  join(folder.write("fine.obj", obj_of({.rows = 60, .columns = 60})));
  EXPECT_EQ(joined, 1);
  EXPECT_FALSE(session.simulation.beside());
  ASSERT_EQ(import.report().size(), 1u);
  EXPECT_FALSE(import.report()[0].refused);
}

TEST_F(ImportTest, LetsAMeshJoinTheSceneBeforeItsOwn) {
  const auto ball = folder.write("ball.obj", obj_of({}));
  load(ball);
  EXPECT_EQ(joined, 0);
  ASSERT_TRUE(import.can_join());
  run(session, 3);
  session.bodies.drop(2);  // goes with the scene of the mesh
  import.join_scene_before();
  EXPECT_EQ(session.world().scene().key, "pair");
  EXPECT_EQ(session.world().bodies().count(), 3u);
  EXPECT_FALSE(import.can_join());
  EXPECT_EQ(session.simulation.notice.text(), "");
  EXPECT_EQ(std::ranges::count(report(), '\n'), 1) << report();
  drop({ball.string(), folder.write("other.obj", obj_of({.rows = 12})).string()});
  EXPECT_EQ(session.world().bodies().count(), 2u) << "together, and nothing else";
  import.join_scene_before();
  EXPECT_EQ(session.world().bodies().count(), 5u);
  drop({ball.string()});
  undo(session.simulation);
  EXPECT_FALSE(import.can_join()) << "its scene was left";
  drop({folder.write("lone.toml", "[[body]]\n").string(), ball.string()});
  EXPECT_EQ(session.world().scene().key, "lone");
  EXPECT_EQ(session.world().bodies().count(), 2u) << "dropped together";
  EXPECT_FALSE(import.can_join());
}

TEST_F(ImportTest, AppliesTheOptionsOfTheCommandLineToTheSceneOfAMesh) {
  import.lone_options = [](softbody::Scene & scene) { scene.collision.tolerance = 0.02f;
};
session.settings.set_integrator({.key = "xpbd"});
load(folder.write("ball.obj", obj_of({})));
EXPECT_EQ(session.world().collision().tolerance, 0.02f);
EXPECT_EQ(session.simulated()->integrator_choice().key, "xpbd");
}  // namespace THIS_FILE

TEST_F(ImportTest, ClosesTheReportAfterAWhileUnlessItRefuses) {
  load(folder.write("ball.obj", obj_of({})));
  for (int seconds = 0; seconds < 10; ++seconds) session.let_pass(0.5);
  EXPECT_EQ(import.report().size(), 1u);
  drop({(folder.path() / "none.obj").string()});
  for (int seconds = 0; seconds < 100; ++seconds) session.let_pass(0.5);
  EXPECT_EQ(import.report().size(), 1u);
  EXPECT_TRUE(refused());
  EXPECT_FALSE(import.can_join());
}

TEST_F(ImportTest, AddsAMeshClearOfEverythingAndSaysWhere) {
  run(session, 5);
  join(folder.write("seamed.obj", obj_of({.scale = 0.001, .bump = 0.3, .seam = true})));
  ASSERT_EQ(session.world().bodies().count(), 3u);
  EXPECT_FALSE(refused());
  EXPECT_EQ(session.world().frame(), 5) << "the world was not restarted";
  EXPECT_TRUE(last().mesh.closed);
  EXPECT_NEAR(last().mesh.vertices.size(), 24 * 15 + 2, 0);
  EXPECT_NE(report().find("welded"), std::string::npos) << report();
  EXPECT_NE(report().find("to 1 m"), std::string::npos) << report();
  EXPECT_EQ(joined, 1);
  ASSERT_TRUE(place);
  const collide::Frame p = session.world().positions();
  const std::uint32_t first = session.world().bodies().first[2];
  for (std::size_t i = first; i < p.x.size(); ++i) {
    const glm::dvec3 here(p.x[i], p.y[i], p.z[i]);
    EXPECT_LT(glm::distance(here, place->centre), 1.1 * place->radius);
    EXPECT_LT(softbody::solid_depth(session.world().scene(), here).depth, 0);
    for (std::size_t j = 0; j < first; ++j)
      EXPECT_GT(glm::distance(here, glm::dvec3(p.x[j], p.y[j], p.z[j])), session.world().collision().tolerance);
  }
  join(folder.write("points.obj", "v 0 0 0\n"));
  EXPECT_EQ(joined, 1) << "it was refused";
  expect_finite_after(30);
}

TEST_F(ImportTest, AppliesSizeAndUpAxis) {
  import.size = 0.25f;
  import.z_is_up = true;
  load(folder.write("flat.obj", "v 0 0 0\nv 4 0 0\nv 4 1 0\nv 0 1 0\nv 0 0 2\nf 1 3 2\nf 1 4 3\nf 1 2 5\nf 2 3 5\n"));
  glm::dvec3 lo(1e9), hi(-1e9);
  for (const glm::dvec3& v : last().mesh.vertices) lo = glm::min(lo, v), hi = glm::max(hi, v);
  EXPECT_NEAR(hi.x - lo.x, 0.25, 1e-6);
  EXPECT_NEAR(hi.y - lo.y, 0.125, 1e-6);
}

TEST_F(ImportTest, SharesMaterialsAndRemovesMeshesAtAReset) {
  const auto file = folder.write("ball.obj", obj_of({}));
  join(file);
  run(session, 4);
  join(file);
  ASSERT_EQ(session.world().bodies().count(), 4u);
  EXPECT_EQ(session.world().scene().materials.size(), 2u);
  session.simulation.reset();
  EXPECT_EQ(session.simulation.notice.text(), "");
  run(session, 6);
  EXPECT_EQ(session.world().bodies().count(), 2u);
  undo(session.simulation);
  EXPECT_EQ(session.world().bodies().count(), 4u);
}

TEST_F(ImportTest, SavesTheMeshWithTheScene) {
  import.weld = 0.001;
  join(folder.write("ball.obj", obj_of({.bump = 0.1})));
  ASSERT_EQ(session.scenes.save(folder.path() / "with mesh.toml", {}), "");
  const softbody::Scene saved = softbody::load_scene(folder.path() / "with mesh.toml");
  EXPECT_EQ(saved.bodies.back().mesh.file.weld, 0.001);
  Session again(saved, {}, 1);
  for (Session* each : {&session, &again}) run(*each, 20);
  EXPECT_EQ(again.simulated()->state_hash(), session.simulated()->state_hash());
}

TEST_F(ImportTest, ReplacesTheSceneWhichRunsMeanwhile) {
  import.path = folder.write("lone.toml", "[[body]]\n").string();
  import.load();
  EXPECT_TRUE(import.busy());
  run(session, 1);
  EXPECT_EQ(session.world().frame(), 1);
  EXPECT_EQ(session.world().bodies().count(), 2u) << "until the next update";
  EXPECT_TRUE(import.progress().starts_with("reading lone.toml")) << import.progress();
  wait();
  EXPECT_EQ(import.progress(), "");
  EXPECT_EQ(session.world().scene().key, "lone");
  EXPECT_EQ(session.world().bodies().count(), 1u);
  EXPECT_FALSE(refused());
  EXPECT_EQ(report(), "scene lone.toml\n");
  undo(session.simulation);
  EXPECT_EQ(session.world().bodies().count(), 2u);
}

TEST_F(ImportTest, SimulatesAFineMeshByAsManyParticlesAsAskedFor) {
  const auto file = folder.write("ball.obj", obj_of({.rows = 40, .columns = 60, .bump = 0.2}));
  import.resolution = 300;
  load(file);
  EXPECT_NEAR(double(last().mesh.vertices.size()), 300, 15);
  EXPECT_EQ(last().shown().mesh.vertices.size(), 39u * 60 + 2);
  EXPECT_NE(report().find(" particles, whose surface is within "), std::string::npos) << report();
  expect_finite_after(60);
  import.resolution = 0;
  load(file);
  EXPECT_NEAR(double(last().mesh.vertices.size()), double(softbody::default_resolution), 40);
  EXPECT_EQ(report().find("slower than real time"), std::string::npos) << report();
  import.resolution = 3500;
  load(folder.write("fine.obj", obj_of({.rows = 80, .columns = 120, .bump = 0.2})));
  EXPECT_NE(report().find("slower than real time"), std::string::npos) << report();
}

TEST_F(ImportTest, GivesUpWhatTheUserCancels) {
  const std::string ball = folder.write("ball.obj", obj_of({.rows = 200, .columns = 400})).string();
  import.drop({ball});
  import.drop({ball});
  import.cancel();
  EXPECT_TRUE(import.progress().starts_with("giving up ball.obj")) << import.progress();
  wait();
  EXPECT_EQ(session.world().bodies().count(), 2u);
  EXPECT_TRUE(import.report().empty()) << report();
  load(folder.write("small.obj", obj_of({})));
  EXPECT_EQ(session.world().bodies().count(), 1u) << "the next one is read";
}

TEST_F(ImportTest, MakesTheBodyBesideTheWindow) {
  Background<session::FileReader> reader(Runs::in_slices);
  reader.offer({softbody::MeshFile{.path = folder.write("ball.obj", obj_of({})), .size = 1}});
  const auto stage = reader.take({});
  ASSERT_TRUE(stage);
  EXPECT_TRUE(std::holds_alternative<session::FileReader::Stage>(*stage)) << "the body is made in a later part";
  EXPECT_FALSE(reader.take({})) << "the coarse mesh is a part of its own";
  const session::FileReader::Answer answer = *reader.take({});
  const auto& mesh = std::get<session::FileReader::Mesh>(answer);
  EXPECT_EQ(softbody::shared_body_model(mesh.mesh, session::imported_material(mesh.mesh.imported->findings.extent)),
            mesh.model);
  session.bodies.add(session::place_above(session.world(), mesh.mesh),
                     session::imported_material(mesh.mesh.imported->findings.extent));
  EXPECT_EQ(&last(), mesh.model.get());
}

TEST_F(ImportTest, ReportsOnEachFileOfABatch) {
  const std::string ball = folder.write("BALL.OBJ", obj_of({})).string(), none = (folder.path() / "none.obj").string(),
                    stl = (folder.path() / "model.stl").string();
  drop({none, ball, stl, ball});
  EXPECT_EQ(session.world().bodies().count(), 2u) << "together";
  ASSERT_EQ(import.report().size(), 4u) << report();
  for (std::size_t i = 0; i < 4; ++i) EXPECT_EQ(import.report()[i].refused, i % 2 == 0) << report();
  for (int i = 0; i < 3; ++i) drop({ball});
  ASSERT_EQ(import.report().size(), 5u) << "the oldest that were accepted are gone: " << report();
  EXPECT_NE(report().find("none.obj"), std::string::npos) << report();
  EXPECT_NE(report().find("model.stl"), std::string::npos) << report();
  drop({none, none, none, none, ball});
  EXPECT_EQ(std::ranges::count(import.report(), true, &session::Import::FileReport::refused), 6)
      << "no refusal is lost";
  EXPECT_FALSE(refused()) << "nor is the newest report";
  load(ball);
  EXPECT_EQ(import.report().size(), 1u) << report();
}

/// Two triangles, of which the second is `gap` away.
std::string two_triangles(double gap) {
  std::ostringstream text;
  text << "o a\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\no b\n";
  for (const char* corner : {"0 0 ", "1 0 ", "0 1 "}) text << "v " << corner << gap << '\n';
  text << "f 4 5 6\n";
  return text.str();
}

TEST_F(ImportTest, AsksWhetherMeshesWithTheSameVerticesAreFramesToPlay) {
  const std::string rest = folder.write("rest.obj", two_triangles(7)).string();
  std::vector<std::string> files;
  for (const int number : {10, 9, 1})
    files.push_back(folder.write("frame_" + std::to_string(number) + ".obj", two_triangles(number)).string());
  const std::string scene = folder.write("scene.toml", "[ground]\n[dropper]\n").string();
  drop({rest, files[0], scene, files[1], files[2]});  // what an export writes beside them is no frame
  EXPECT_NE(import.question().find("3 files; those read so far"), std::string::npos) << import.question();
  EXPECT_EQ(session.world().bodies().count(), 2u) << "nothing happens before the answer";
  import.play();
  EXPECT_EQ(import.question(), "");
  EXPECT_FALSE(session.simulated());
  EXPECT_EQ(session.world().scene().solids.size(), 1u);
  for (const float gap : {1.0f, 9.0f, 10.0f, 1.0f}) {
    EXPECT_EQ(session.world().positions().z[3], gap) << "in the order of their numbers";
    session.advance(tick);
  }
  drop(files);
  EXPECT_EQ(import.question(), "") << "no body could join a recording";
  EXPECT_EQ(session.world().positions().z[3], 1.0f);
  undo(session.simulation);
  undo(session.simulation);
  EXPECT_TRUE(session.simulated());
  drop({files[0], files[1], scene});
  import.import_each();
  wait();
  EXPECT_EQ(import.question(), "");
  ASSERT_EQ(import.report().size(), 4u) << report();
  drop({files[0], files[1]});
  import.dismiss_report();
  EXPECT_EQ(import.question(), "");
  drop({files[0], rest});
  EXPECT_EQ(import.question(), "") << "one frame is no motion";
}

TEST_F(ImportTest, LosesNoFileThatIsDroppedWhileOthersAreCheckedOrAsk) {
  const std::string ball = folder.write("ball.obj", obj_of({})).string(),
                    other = folder.write("other.obj", obj_of({.rows = 12})).string(),
                    late = folder.write("late.obj", obj_of({.rows = 14})).string();
  import.drop({ball, other});
  import.drop({late});  // before it is known that the others are no frames
  wait();
  EXPECT_EQ(import.question(), "");
  EXPECT_EQ(session.world().bodies().count(), 3u) << report();
  EXPECT_EQ(import.path, late) << "in the order in which they were dropped";
  const std::string one = folder.write("one.obj", two_triangles(1)).string(),
                    two = folder.write("two.obj", two_triangles(2)).string();
  drop({one, two});
  ASSERT_NE(import.question(), "");
  drop({late, late});
  EXPECT_NE(import.question(), "") << "the later files wait";
  EXPECT_EQ(session.world().bodies().count(), 3u);
  import.import_each();
  EXPECT_EQ(import.path, one);
  wait();
  EXPECT_EQ(session.world().bodies().count(), 4u) << report();
  EXPECT_EQ(import.path, late);
}

TEST_F(ImportTest, ReportsWhyAFileIsRefused) {
  const std::string fan = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nv 0 -1 0\nf 1 2 3\nf 1 2 4\nf 1 2 5\n";
  struct Case {
    std::filesystem::path file;
    const char* says;
  };
  const std::vector<Case> cases{{folder.write("fan.obj", fan), "delete all but two of these faces"},
                                {folder.write("points.obj", "v 0 0 0\n"), "no face"},
                                {folder.path() / "none.obj", "cannot be read"},
                                {folder.write("bad.obj", "v 0 zero 0\n"), "bad.obj:1"},
                                {folder.write("bad.toml", "name = 1\n"), "bad.toml:1"},
                                {folder.write("model.stl", "solid\n"), "neither a mesh"}};
  const auto expect_unchanged = [&] {
    EXPECT_EQ(session.simulation.notice.text(), "") << "it would be shown twice";
    EXPECT_EQ(session.world().bodies().count(), 2u);
    EXPECT_FALSE(session.simulation.clock.paused);
  };
  for (const auto& [file, says] : cases) {
    load(file);
    EXPECT_NE(import.problem().find(says), std::string::npos) << import.problem();
    EXPECT_TRUE(import.report().empty()) << "it stands where the file was asked for: " << report();
    expect_unchanged();
    import.path += "x";
    EXPECT_EQ(import.problem(), "") << "of another file";
    drop({file.string()});
    EXPECT_TRUE(refused()) << file;
    EXPECT_NE(report().find(says), std::string::npos) << report();
    EXPECT_EQ(import.problem(), "");
    expect_unchanged();
  }
  load(folder.path() / "none.obj");
  EXPECT_NE(import.problem(), "");
  load(folder.write("none.obj", obj_of({})));
  EXPECT_EQ(import.problem(), "") << "mended";
  EXPECT_EQ(session.world().bodies().count(), 1u);
}

}  // namespace app
}  // namespace app

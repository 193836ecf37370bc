// Scene files that are not in order: one line that names the file, the line and what to do.

#include <gtest/gtest.h>

#include "tests/softbody/helpers.h"

namespace softbody::test {
namespace THIS_FILE {

struct Bad {
  const char* name;
  std::string toml;
  int line;  // 0: the whole file
  const char* says;
};

const Bad bad_scenes[]{
    {"unknown_key", "name = \"x\"\ngravitas = 1\n[[body]]\n", 2, "gravitas is not known here"},
    {"unknown_key_in_body", "[[body]]\n\npositions = [0, 1, 2]\n", 3, "body[0].positions is not known here"},
    {"unknown_key_in_second_body", "[[body]]\n[[body]]\nhue = 1\n", 3, "body[1].hue"},
    {"unknown_key_in_material", "[[material]]\nmas = 1\n[[body]]\n", 2, "material[0].mas"},
    {"unknown_key_in_springs", "[[material]]\nbend = {stiff = 1}\n[[body]]\n", 2, "bend.stiff"},
    {"unknown_key_in_mesh", "[[body]]\nmesh = {kind = \"icosphere\", rows = 3}\n", 2, "mesh.rows"},
    {"unknown_key_in_collision", "[collision]\ntolerence = 1\n[[body]]\n", 2, "collision.tolerence"},
    {"unknown_key_in_ground", "[ground]\nhigh = 1\n[[body]]\n", 2, "ground.high"},
    {"unknown_key_in_dropper", "[dropper]\nappear = 1\n", 2, "dropper.appear"},
    {"unknown_key_in_sleep", "[[body]]\n[sleep]\nframe = 1\n", 3, "sleep.frame"},
    {"unknown_key_in_view", "[[body]]\n[view]\nzoom = 1\n", 3, "view.zoom"},
    {"unknown_key_in_caption", "[[body]]\n[[caption]]\nwords = \"\"\n", 3, "caption[0].words"},
    {"unknown_table", "[[body]]\n[grounds]\n", 2, "grounds is not known here"},
    {"unknown_table_beside_those_that_are_optional", "[[body]]\n[groud]\n", 2, "collision, dropper, gravity, ground,"},
    {"key_with_a_line_break", "\"a\\nb\" = 1\n[[body]]\n", 1, "is not known here"},
    {"value_cut_short_by_a_line_break", "thickness =t\n", 1, ""},
    {"number_as_text", "[[material]]\nmass = \"1\"\n[[body]]\n", 2, "material[0].mass must be a number"},
    {"number_as_bool", "[[material]]\nfriction = true\n[[body]]\n", 2, "must be a number"},
    {"name_of_two_lines", "[[material]]\nname = \"a\\nb\"\n[[material]]\nname = \"a\\nb\"\n[[body]]\n", 4,
     "'a?b' is that of"},
    {"text_as_number", "name = 5\n[[body]]\n", 1, "name must be a string"},
    {"bool_as_number", "[collision]\nself_collision = 1\n[[body]]\n", 2, "must be true or false"},
    {"whole_number_as_fraction", "[collision]\nlevels = 3.0\n[[body]]\n", 2, "must be a whole number"},
    {"vector_of_two", "[[body]]\nposition = [1, 2]\n", 2, "must be three numbers"},
    {"vector_as_number", "gravity = -9.81\n[[body]]\n", 1, "must be three numbers"},
    {"vector_with_text", "[[body]]\nvelocity = [1, \"2\", 3]\n", 2, "must be three numbers"},
    {"table_as_number", "collision = 3\n[[body]]\n", 1, "must be a table"},
    {"ground_as_list", "[[ground]]\n[[body]]\n", 1, "must be a table"},
    {"bodies_as_table", "[body]\n", 1, "[[body]]"},
    {"springs_as_number", "[[material]]\nstructural = 300\n[[body]]\n", 2, "must be a table"},
    {"mass_zero", "[[material]]\nmass = 0\n[[body]]\n", 2, "mass must be a number from"},
    {"friction_negative", "[ground]\nfriction = -0.1\n[[body]]\n", 2, "friction must be"},
    {"restitution_above_one", "[ground]\nrestitution = 1.1\n[[body]]\n", 2, "restitution must be a number from 0 to 1"},
    {"plane_without_direction", "[[solid_plane]]\nnormal = [0, 0, 0]\n[[body]]\n", 2, "normal must have a length"},
    {"unknown_key_in_box", "[[solid_box]]\nhalf = 1\n[[body]]\n", 2, "solid_box[0].half"},
    {"box_flat", "[[solid_box]]\nsize = [1, 0, 1]\n[[body]]\n", 2, "size must be three numbers, each from"},
    {"box_rotation_without_axis", "[[solid_box]]\nrotation = {axis = [0, 0, 0]}\n[[body]]\n", 2, "axis must have a"},
    {"box_rotation_too_far", "[[solid_box]]\nrotation = {degrees = 361}\n[[body]]\n", 2, "from -360 to 360"},
    {"unknown_key_in_rotation", "[[solid_box]]\nrotation = {angle = 3}\n[[body]]\n", 2, "rotation.angle"},
    {"capsule_end_infinite", "[[solid_capsule]]\nto = [inf, 0, 0]\n[[body]]\n", 2, "to must be three numbers"},
    {"planes_as_table", "[solid_plane]\n[[body]]\n", 1, "[[solid_plane]]"},
    {"spin_without_axis", "[[body]]\nspin = {axis = [0, 0, 0]}\n", 2, "axis must have a length"},
    {"spin_too_fast", "[[body]]\nspin = {degrees_per_second = 36001}\n", 2, "from -36000 to 36000"},
    {"spin_as_number", "[[body]]\nspin = 90\n", 2, "spin must be a table"},
    {"unknown_key_in_spin", "[[body]]\nspin = {through = [0, 0, 0]}\n", 2, "spin.through is not known here"},
    {"body_rotation_too_far", "[[body]]\nrotation = {degrees = 361}\n", 2, "from -360 to 360"},
    {"body_axes_skewed", "[[body]]\nrotation = {axes = [[1, 0, 0], [1, 1, 0], [0, 0, 1]]}\n", 2, "axes must be three"},
    {"hold_as_table", "[[body]]\nhold = {box = {}}\n", 2, "must be a list of tables"},
    {"hold_nowhere", "[[body]]\nhold = [{until = 9}]\n", 2, "box or sphere must say where"},
    {"hold_in_two_places", "[[body]]\nhold = [{box = {}, sphere = {}}]\n", 2, "box or sphere must say where"},
    {"hold_of_no_vertices", "[[body]]\nhold = [{vertices = []}]\n", 2, "vertices must be a list of whole numbers"},
    {"hold_of_minus_one", "[[body]]\nhold = [{vertices = [3, -1]}]\n", 2, "vertices must be whole numbers from 0 on"},
    {"hold_ends_before_it_begins", "[[body]]\nhold = [{vertices = [3], from = 9, until = 9}]\n", 2, "from 10 to"},
    {"hold_in_a_capsule", "[[body]]\nhold = [{box = {}, capsule = {}}]\n", 2, "hold[0].capsule is not known here"},
    {"hold_box_flat", "[[body]]\nhold = [{box = {size = [1, 0, 1]}}]\n", 2, "size must be three numbers, each from"},
    {"hold_sphere_radius", "[[body]]\nhold = [{sphere = {radius = 0}}]\n", 2, "radius must be a number from"},
    {"hold_ends_at_once", "[[body]]\nappear = 5\nhold = [{sphere = {}, until = 5}]\n", 3, "whole number from 6 to"},
    {"hold_velocity", "[[body]]\nhold = [{sphere = {}, velocity = [0, 1001, 0]}]\n", 2, "velocity must be three"},
    {"hold_turn_axis", "[[body]]\nhold = [{sphere = {}, turn = {axis = [0, 0, 0]}}]\n", 2, "axis must have a length"},
    {"unknown_key_in_turn", "[[body]]\nhold = [{sphere = {}, turn = {degrees = 3}}]\n", 2, "turn.degrees is not"},
    {"hold_of_dropper", "[[body]]\n[dropper]\nhold = [{sphere = {}}]\n", 3, "dropper.hold is not known here"},
    {"wind_strong", "[[body]]\n[air]\nwind = [0, 0, 1001]\n", 3, "wind must be three numbers, each from -1000"},
    {"unknown_key_in_air", "[[body]]\n[air]\ndrag = 1\n", 3, "air.drag is not known here"},
    {"air_drag_negative", "[[material]]\nair_drag = -1\n[[body]]\n", 2, "air_drag must be a number from 0"},
    {"body_too_small", "[[body]]\nmesh = {kind = \"icosphere\", radius = 9e-4}\n", 2, "from 0.001 to 10000"},
    {"sheet_too_small", "[[body]]\nmesh = {kind = \"grid\", depth = 9e-4}\n", 2, "from 0.001 to 10000"},
    {"contact_surface_unknown", "[collision]\ncontact_surface = \"edges\"\n[[body]]\n", 2,
     "contact_surface must be one of: vertex-vertex, surface"},
    {"contact_surface_as_number", "[collision]\ncontact_surface = 1\n[[body]]\n", 2, "must be a string"},
    {"tolerance_zero", "[collision]\ntolerance = 0\n[[body]]\n", 2, "tolerance must be"},
    {"tolerance_wide", "[collision]\ntolerance = 10.1\n[[body]]\n", 2, "tolerance must be a number from 1e-09 to 10"},
    {"gravity_strong", "gravity = [0, -1001, 0]\n[[body]]\n", 1,
     "gravity must be three numbers, each from -1000 to 1000"},
    {"levels_16", "[collision]\nlevels = 16\n[[body]]\n", 2, "from 0 to 15"},
    {"levels_negative", "[collision]\nlevels = -1\n[[body]]\n", 2, "from 0 to 15"},
    {"buckets_zero", "[collision]\nbuckets = 0\n[[body]]\n", 2, "from 1 to 16777216"},
    {"buckets_huge", "[collision]\nbuckets = 9223372036854775807\n[[body]]\n", 2, "from 1 to 16777216"},
    {"cell_size_zero", "[collision]\ncell_size = [1, 0, 1]\n[[body]]\n", 2, "cell_size must be"},
    {"prime_zero", "[collision]\nprimes = [3, 0, 5]\n[[body]]\n", 2, "primes must be three numbers, each from 1"},
    {"prime_too_large", "[collision]\nprimes = [3, 4294967296, 5]\n[[body]]\n", 2, "from 1 to 4294967295"},
    {"prime_fraction", "[collision]\nprimes = [3, 2.5, 5]\n[[body]]\n", 2, "primes must be three whole numbers"},
    {"subdivisions_7", "[[body]]\nmesh = {subdivisions = 7}\n", 2, "from 0 to 6"},
    {"columns_zero", "[[body]]\nmesh = {kind = \"grid\", columns = 0}\n", 2, "from 1 to 1000"},
    {"columns_1001", "[[body]]\nmesh = {kind = \"grid\", columns = 1001}\n", 2, "from 1 to 1000"},
    {"rows_1001", "[[body]]\nmesh = {kind = \"grid\", rows = 1001}\n", 2, "from 1 to 1000"},
    {"frame_negative", "[[body]]\nappear = -1\n", 2, "appear must be"},
    {"frames_zero", "[[body]]\n[sleep]\nframes = 0\n", 3, "frames must be"},
    {"nan", "[[material]]\nmass = nan\n[[body]]\n", 2, "mass must be a number"},
    {"infinite", "[[material]]\ngas_pressure = inf\n[[body]]\n", 2, "gas_pressure must be a number"},
    {"infinite_in_vector", "gravity = [0, -inf, 0]\n[[body]]\n", 1, "gravity must be three numbers"},
    {"unknown_method", "[collision]\nmethod = \"magic\"\n[[body]]\n", 2, "multi-level-sb-exact"},
    {"materials_of_one_name", "[[material]]\nname = \"a\"\n[[material]]\nname = \"a\"\n[[body]]\n", 4,
     "earlier [[material]]"},
    {"axes_askew", "[[solid_box]]\nrotation = {axes = [[1, 0, 0], [0, 1, 0], [0, 0.1, 1]]}\n[[body]]\n", 2,
     "right angles"},
    {"axes_mirrored", "[[solid_box]]\nrotation = {axes = [[1, 0, 0], [0, 1, 0], [0, 0, -1]]}\n[[body]]\n", 2,
     "right-handed"},
    {"axes_of_two", "[[solid_box]]\nrotation = {axes = [[1, 0, 0], [0, 1, 0]]}\n[[body]]\n", 2, "three times three"},
    {"unknown_material", "[[material]]\nname = \"a\"\n[[body]]\nmaterial = \"b\"\n", 4, "names no [[material]]"},
    {"unknown_mesh", "[[body]]\nmesh = {kind = \"teapot\"}\n", 2, "\"icosphere\", \"grid\" or \"file\""},
    {"release_before_appear", "[[body]]\nappear = 9\nrelease = 8\n", 3, "must not come before appear"},
    {"unknown_key_in_lattice", "[[body]]\nlattice = {sise = [1, 1, 1]}\n", 2, "lattice.sise"},
    {"lattice_of_none", "[[body]]\nlattice = {size = [1, 0, 1]}\n", 2, "lattice.size must be"},
    {"lattice_of_fractions", "[[body]]\nlattice = {size = [1, 2.5, 1]}\n", 2, "lattice.size must be"},
    {"lattice_too_few", "[[body]]\nlattice = {size = [2, 2, 2], number = 9}\n", 2, "from 1 to 8"},
    {"lattice_too_large", "[[body]]\nlattice = {size = [1000, 1000, 1000]}\n", 2, "particles"},
    {"lattices_too_large_together",
     "[[body]]\nlattice = {size = [100, 10, 20]}\n[[body]]\nlattice = {size = [100, 10, 5]}\n", 4,
     "to 4050000 particles; at most 4000000"},
    {"no_body", "name = \"empty\"\n", 0, "add a [[body]] or a [dropper]"},
    {"empty_file", "", 0, "has no body"},
    {"unclosed_string", "name = \"x\n[[body]]\n", 1, ""},
    {"no_value", "[[body]]\nposition =\n", 2, ""},
    {"key_twice", "name = \"x\"\nname = \"y\"\n[[body]]\n", 2, ""},
    {"binary", std::string("\x00\x01\xff\xfe", 4), 1, ""},
    {"bad_utf8", "name = \"\xc3\x28\"\n[[body]]\n", 1, ""},
    {"deep_nesting", "name = " + std::string(100000, '[') + "\n", 1, ""},
};

TEST(SceneErrors, NameFileAndLineAndWhatIsWrong) {
  const TemporaryFolder folder;
  for (const Bad& bad : bad_scenes) {
    SCOPED_TRACE(bad.name);
    const auto file = folder.write("bad.toml", bad.toml);
    const std::string message = error_of([&] { load_scene(file); });
    const std::string place = file.string() + ":" + (bad.line ? std::to_string(bad.line) + ": " : " ");
    EXPECT_EQ(message.substr(0, place.size()), place) << message;
    EXPECT_NE(message.find(bad.says), std::string::npos) << message;
  }
}

TEST(SceneErrors, NameAMissingFileAFolderAndAFileThatIsTooLarge) {
  const TemporaryFolder folder;
  const auto missing = folder.path() / "missing.toml";
  expect_error(missing.string() + ": cannot be read", [&] { load_scene(missing); });
  EXPECT_THROW(load_scene(folder.path()), SceneError);
  const auto large = folder.write("large.toml", "[[body]]\n#" + std::string(16 << 20, 'x') + "\n");
  expect_error("larger than 16 MiB", [&] { load_scene(large); });
}

TEST(SceneErrors, ListTheKnownScenesForAnUnknownKey) {
  expect_error("unknown scene 'dorp'; use one of: ", [] { find_scene("dorp", SBCOLLIDE_SCENES); });
  expect_error("drop", [] { find_scene("dorp", SBCOLLIDE_SCENES); });
}

}  // namespace THIS_FILE
}  // namespace softbody::test

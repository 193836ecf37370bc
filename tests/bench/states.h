#pragma once
// What the benchmark runs on: bodies of one mesh in a few sizes, recorded as consecutive frames, in a file each; or the
// meshes of files.

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "collide/core/frame.h"

namespace bench {

/// Every body is the paper's: an icosphere of 162 vertices and 320 faces.
inline constexpr int subdivisions = 2;
/// Mean edge in metres of the body of radius 0.5 m: the unit of tolerances and of motion.
inline constexpr double mean_edge = 0.1497;

struct State {
  struct Positions {
    std::vector<float> x, y, z;  // m, world
    bool operator==(const Positions&) const = default;
  };
  std::string key;
  std::vector<float> radius{};  // m at rest, one a body; none of meshes from files
  std::vector<Positions> frames{};
  collide::Bodies bodies{};                   // of recorded states, they follow from `radius`: see make_bodies()
  double edge = mean_edge, unit = mean_edge;  // m: its mean edge; what tolerances and motion are given in
  std::string unit_name = "edges";

  collide::Frame frame(std::size_t k) const { return {frames[k].x, frames[k].y, frames[k].z, &bodies}; }
};

/// One icosphere a body; bodies of equal radius share their shape, rest positions included.
collide::Bodies make_bodies(const std::vector<float>& radius);

/// Mean distance in metres that a vertex moves from one frame to the next; 0 for a single frame.
double mean_displacement(const State& state);

/// Writes FOLDER/KEY.state, little endian: the 8 characters "SBSTATE1"; uint32 number of bodies, uint32 number of
/// frames; float32 radius of each body; for each frame the float32 x of all vertices, then all y, then all z.
/// Throws app::UsageError if it cannot be written.
void save(const State& state, const std::filesystem::path& folder);

/// Reads mesh files that are consecutive frames; their unit is the metre. rest: a file with the same bodies at rest, or
/// none. Throws app::UsageError and MeshFileError as app::files::FrameSequence does, and for fewer than two frames.
State read_meshes(const std::vector<std::filesystem::path>& files, const std::optional<std::filesystem::path>& rest);

/// Reads all states of a folder, in the order of bodies, then keys. Throws app::UsageError for a folder without any and
/// for a file that is not whole.
std::vector<State> load_states(const std::filesystem::path& folder);

}  // namespace bench

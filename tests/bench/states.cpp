#include "tests/bench/states.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <fstream>
#include <map>

#include <glm/geometric.hpp>

#include "app/cli/options.h"
#include "app/files/frame_sequence.h"
#include "app/files/output_file.h"
#include "softbody/mesh/mesh.h"

namespace bench {
namespace {

namespace fs = std::filesystem;

static_assert(std::endian::native == std::endian::little, "state files are little endian");
constexpr std::string_view magic = "SBSTATE1";
constexpr std::uint32_t max_bodies = 1'000'000, max_frames = 1000;

std::shared_ptr<const collide::Shape> make_shape(float radius) {
  const softbody::Mesh mesh = softbody::icosphere(subdivisions, radius);
  return std::make_shared<collide::Shape>(static_cast<collide::Index>(mesh.vertices.size()), mesh.edges,
                                          std::vector<glm::vec3>(mesh.vertices.begin(), mesh.vertices.end()));
}

template <class T>
std::string_view bytes_of(const std::vector<T>& values) {
  return {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T)};
}

/// Reads the values of one file and says which file is not whole.
class Reader {
 public:
  explicit Reader(const fs::path& path) : path_(path), in_(path, std::ios::binary) {
    std::string start(magic.size(), '\0');
    if (!in_.read(start.data(), std::streamsize(start.size())) || start != magic)
      fail("cannot be read, or is no state file");
  }
  template <class T>
  std::vector<T> take(std::size_t count) {
    std::vector<T> values(count);
    if (!in_.read(reinterpret_cast<char*>(values.data()), std::streamsize(count * sizeof(T)))) fail("ends too early");
    return values;
  }
  [[noreturn]] void fail(const char* why) const {
    throw app::UsageError(path_.string() + ": " + why + "; record the states anew");
  }

 private:
  fs::path path_;
  std::ifstream in_;
};

State load(const fs::path& path) {
  Reader reader(path);
  const auto counts = reader.take<std::uint32_t>(2);
  if (counts[0] > max_bodies || counts[1] < 1 || counts[1] > max_frames) reader.fail("has impossible counts");
  State state{.key = path.stem().string(), .radius = reader.take<float>(counts[0])};
  if (!std::all_of(state.radius.begin(), state.radius.end(), [](float r) { return r > 0 && std::isfinite(r); }))
    reader.fail("has a radius that is not positive");
  state.bodies = make_bodies(state.radius);
  const std::size_t vertices = state.bodies.vertex_count();
  for (std::uint32_t k = 0; k < counts[1]; ++k) {
    State::Positions& p = state.frames.emplace_back();
    for (auto* coordinate : {&p.x, &p.y, &p.z}) *coordinate = reader.take<float>(vertices);
  }
  return state;
}

}  // namespace

collide::Bodies make_bodies(const std::vector<float>& radius) {
  std::map<float, std::shared_ptr<const collide::Shape>> shapes;
  collide::Bodies bodies;
  for (const float r : radius) {
    auto& shape = shapes[r];
    if (!shape) shape = make_shape(r);
    bodies.add(shape);
  }
  return bodies;
}

double mean_displacement(const State& state) {
  double sum = 0;
  std::size_t count = 0;
  for (std::size_t k = 1; k < state.frames.size(); ++k) {
    const auto &p = state.frames[k - 1], &q = state.frames[k];
    for (std::size_t v = 0; v < p.x.size(); ++v, ++count)
      sum += std::sqrt(double(collide::squared_distance(p.x[v], p.y[v], p.z[v], q.x[v], q.y[v], q.z[v])));
  }
  return count > 0 ? sum / double(count) : 0;
}

void save(const State& state, const fs::path& folder) {
  app::files::OutputFile file(folder / (state.key + ".state"));
  file.write(magic);
  file.write(bytes_of(std::vector{std::uint32_t(state.radius.size()), std::uint32_t(state.frames.size())}));
  file.write(bytes_of(state.radius));
  for (const State::Positions& p : state.frames)
    for (const auto* coordinate : {&p.x, &p.y, &p.z}) file.write(bytes_of(*coordinate));
  file.commit();
}

State read_meshes(const std::vector<fs::path>& files, const std::optional<fs::path>& rest) {
  app::files::FrameSequence sequence(files, {.rest = rest});
  if (sequence.count() < 2)
    throw app::UsageError(files.front().string() + ": one frame; give two at least, since the first one is not timed");
  State state{.key = files.front().stem().string(), .bodies = sequence.bodies()->bodies, .unit = 1, .unit_name = "m"};
  for (std::size_t k = 0; k < sequence.count(); ++k) {
    const softbody::Points at = sequence.read(k).at;
    for (const auto* axis : {&at.x, &at.y, &at.z})
      if (!std::all_of(axis->begin(), axis->end(), [](float value) { return std::isfinite(value); }))
        throw app::UsageError(files[k].string() + ": has a coordinate that is not finite");
    state.frames.push_back({{at.x.begin(), at.x.end()}, {at.y.begin(), at.y.end()}, {at.z.begin(), at.z.end()}});
  }
  const collide::Frame first = state.frame(0);
  double sum = 0;
  std::size_t edges = 0;
  for (collide::Index b = 0; b < state.bodies.count(); ++b) {
    const collide::Index begin = state.bodies.first[b];
    for (collide::Index v = 0; v < state.bodies.size(b); ++v) {
      for (const collide::Index other : state.bodies.shape[b]->topology().neighbours(v)) {
        sum += glm::distance(position(first, begin + v), position(first, begin + other));
        ++edges;
      }
    }
  }
  state.edge = edges > 0 ? sum / double(edges) : 0;
  return state;
}

std::vector<State> load_states(const fs::path& folder) {
  std::vector<State> states;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder, error))
    if (entry.path().extension() == ".state") states.push_back(load(entry.path()));
  if (states.empty())
    throw app::UsageError(folder.string() + ": holds no states; record them first: bench_detection record DIR");
  std::sort(states.begin(), states.end(), [](const State& a, const State& b) {
    return std::pair(a.radius.size(), a.key) < std::pair(b.radius.size(), b.key);
  });
  return states;
}

}  // namespace bench

#include "tests/bench/states.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <fstream>
#include <map>

#include "app/cli/options.h"
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
  State state{.key = path.stem().string(), .radius = reader.take<float>(counts[0]), .frames = {}, .bodies = {}};
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

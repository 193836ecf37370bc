#include "app/render/miss_marks.h"

#include <algorithm>
#include <cassert>
#include <map>
#include <string>
#include <utility>

#include <glm/geometric.hpp>

#include "app/render/palette.h"
#include "softbody/model/body_model.h"

namespace app::render {
namespace {

struct Group {
  glm::vec3 first;  // m, the middle of its first contact
  glm::vec3 sum{0.0f};
  int count = 0;
};

}  // namespace

std::vector<SceneLabel> miss_marks(const softbody::BodiesInMotion& world, std::span<const collide::Contact> missed,
                                   const DrawnPositions& positions) {
  constexpr double reach = 4;  // of a group, mean edges
  std::map<std::pair<softbody::BodyId, softbody::BodyId>, std::vector<Group>> groups;
  for (const collide::Contact& contact : missed) {
    assert(contact.a < positions.size() && contact.b < positions.size());
    const softbody::BodyId body = world.bodies().body_of(contact.a);
    const glm::vec3 middle = 0.5f * (positions[contact.a] + positions[contact.b]);
    const auto near = static_cast<float>(reach * world.model(body).shown().mean_edge);
    std::vector<Group>& of_pair = groups[{body, world.bodies().body_of(contact.b)}];
    auto group = std::ranges::find_if(of_pair, [&](const Group& g) { return glm::distance(g.first, middle) < near; });
    if (group == of_pair.end()) group = of_pair.insert(group, {.first = middle});
    group->sum += middle;
    ++group->count;
  }
  std::vector<Group> all;
  for (const auto& [pair, of_pair] : groups) all.insert(all.end(), of_pair.begin(), of_pair.end());
  std::ranges::stable_sort(all, std::ranges::greater{}, &Group::count);
  if (all.size() > max_miss_marks) all.resize(max_miss_marks);
  std::vector<SceneLabel> marks;
  for (const Group& group : all)
    marks.push_back(
        {group.sum / static_cast<float>(group.count), std::to_string(group.count) + " missed", contact_missed_colour});
  return marks;
}

}  // namespace app::render

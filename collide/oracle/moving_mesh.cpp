#include "collide/oracle/moving_mesh.h"

namespace collide::oracle {

namespace {

MovingFeatures features_of(const MovingMesh& mesh, const MovingPair& pair) {
  const std::vector<MovingPoint>& points = mesh.points;
  const auto& [kind, a, b] = pair;
  if (kind == MovingPair::Kind::vertex_face) return {kind, {points[a[0]], points[b[0]], points[b[1]], points[b[2]]}};
  return {kind, {points[a[0]], points[a[1]], points[b[0]], points[b[1]]}};
}

}  // namespace

std::optional<Meeting> meeting_of(const MovingMesh& mesh, const MovingPair& pair) {
  return meeting_of(features_of(mesh, pair));
}

std::optional<Passage> passage_of(const MovingMesh& mesh, const MovingPair& pair) {
  return passage_of(features_of(mesh, pair));
}

void find_meetings(const MovingMesh& mesh, Workers& workers,
                   const std::function<void(const std::vector<FeatureMeeting>&)>& take) {
  search_pairs<FeatureMeeting>(
      mesh, workers,
      [&](const MovingPair& pair) -> std::optional<FeatureMeeting> {
        const std::optional<Meeting> meeting = meeting_of(mesh, pair);
        if (!meeting) return std::nullopt;
        return FeatureMeeting{pair, *meeting, passage_of(mesh, pair).has_value()};
      },
      take);
}

}  // namespace collide::oracle

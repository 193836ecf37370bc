#include "collide/oracle/moving_mesh.h"

namespace collide::oracle {

namespace {

/// Calls the query of the kind of the pair with its four points.
template <class VertexFace, class EdgeEdge>
auto ask(const MovingMesh& mesh, const MovingPair& pair, const VertexFace& vertex_face, const EdgeEdge& edge_edge) {
  const auto point = [&](Index v) -> const MovingPoint& { return mesh.points[v]; };
  const auto& [kind, a, b] = pair;
  return kind == MovingPair::Kind::vertex_face ? vertex_face(point(a[0]), point(b[0]), point(b[1]), point(b[2]))
                                               : edge_edge(point(a[0]), point(a[1]), point(b[0]), point(b[1]));
}

}  // namespace

std::optional<Meeting> meeting_of(const MovingMesh& mesh, const MovingPair& pair) {
  return ask(mesh, pair, vertex_meets_face, edge_meets_edge);
}

std::optional<Passage> passage_of(const MovingMesh& mesh, const MovingPair& pair) {
  return ask(mesh, pair, vertex_through_face, edge_through_edge);
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

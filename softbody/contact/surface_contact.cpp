#include "softbody/contact/surface_contact.h"

#include <algorithm>

namespace softbody {

void SurfaceContact::make_rows(int thread, int threads, Field<const float> x, Field<const float> before, float elapsed,
                               float h) {
  OfThread& own = of_thread_[static_cast<std::size_t>(thread)];
  own.rows.clear();
  SurfaceRowMaker maker(candidates_, {x, before, h, elapsed + h, last_h_ > 0 ? h / last_h_ : 0}, own.scratch, own.rows);
  const collide::Part part = collide::part_of(candidates_.pairs().size(), thread, threads);
  for (std::size_t i = part.begin; i < part.end; ++i) {
    candidates_.pairs()[i].thread = thread;
    candidates_.pairs()[i].closes = candidates_.pairs()[i].joins = false;
    maker.add_rows(candidates_.pairs()[i]);
  }
}

std::size_t SurfaceContact::rows() const {
  std::size_t sum = 0;
  for (const Pair& p : candidates_.pairs()) sum += p.rows;
  return sum;
}

bool SurfaceContact::presses() const {
  return std::ranges::any_of(candidates_.pairs(), [&](const Pair& p) {
    return std::ranges::any_of(rows_of(p), [](const ContactRow& row) { return row.normal_impulse > 0; });
  });
}

std::vector<SurfaceContactPoint> SurfaceContact::contact_points(const collide::Bodies& vertices) const {
  std::vector<SurfaceContactPoint> list;
  for (const Pair& p : candidates_.pairs())
    for (const ContactRow& row : rows_of(p)) {
      if (row.normal_impulse <= 0) continue;
      SurfaceContactPoint& point = list.emplace_back();
      point.a = candidates_.vertex_at(p, row.slot[0]).first;
      point.b = candidates_.vertex_at(p, row.slot[3]).first;
      point.weight = row.weight;
      point.normal = row.normal;
      for (std::size_t k = 0; k < 4; ++k) {
        const auto& [body, vertex] = candidates_.vertex_at(p, row.slot[k]);
        point.vertex[k] = vertices.first[body] + vertex;
      }
    }
  return list;
}

/// Keeps only features of which something is remembered, see SurfaceCandidates::save(), and rows that pressed.
SurfaceContact::State SurfaceContact::save() const {
  State state{.candidates = candidates_.save(), .rows = {}, .last_h = last_h_};
  for (Pair& kept : state.candidates.pairs) {
    const std::span<const ContactRow> rows = rows_of(kept);
    kept.thread = 0;
    kept.first_row = static_cast<std::uint32_t>(state.rows.size());
    std::ranges::copy_if(rows, std::back_inserter(state.rows),
                         [](const ContactRow& row) { return row.normal_impulse > 0; });
    kept.rows = static_cast<std::uint32_t>(state.rows.size()) - kept.first_row;
  }
  return state;
}

void SurfaceContact::restore(const State& state) {
  candidates_.restore(state.candidates);
  of_thread_.resize(std::max(of_thread_.size(), std::size_t{1}));
  for (OfThread& own : of_thread_) own.joint_work = 0;
  of_thread_[0].rows = state.rows;
  last_h_ = state.last_h;
}

}  // namespace softbody

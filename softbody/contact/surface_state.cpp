// Surface contact: what it remembers, taken away and put back.

#include <algorithm>
#include <array>
#include <bit>

#include "softbody/contact/surface_contact.h"

namespace softbody {

/// Only features of which something is remembered are kept: most candidates are far apart and forgotten at once.
SurfaceContact::State SurfaceContact::save() const {
  State state;
  state.traits = traits_;
  state.bodies = bodies_;
  state.last_h = last_h_;
  for (Index body = 0; body < bodies_.size(); ++body) state.history.push_back(search_.history(body));
  // By its bits: a zero's sign is handed on too.
  const auto blank = [](const CachedContact& m) {
    return std::bit_cast<std::array<char, sizeof(CachedContact)>>(m) ==
           std::bit_cast<std::array<char, sizeof(CachedContact)>>(CachedContact{});
  };
  const auto keep_features = [&](std::uint32_t begin, std::uint32_t end) {
    for (std::uint32_t i = begin; i < end; ++i) {
      if (blank(cached_[i])) continue;
      state.features.push_back(search_.features()[i]);
      state.cached.push_back(cached_[i]);
    }
    return static_cast<std::uint32_t>(state.features.size());
  };
  for (const Pair& pair : pairs_) {
    Pair& kept = state.pairs.emplace_back(pair);
    const collide::surface::SurfacePair& from = pair.range;
    kept.range.vertex_face = static_cast<std::uint32_t>(state.features.size());
    kept.range.face_vertex = keep_features(from.vertex_face, from.face_vertex);
    kept.range.edge_edge = keep_features(from.face_vertex, from.edge_edge);
    kept.range.end = keep_features(from.edge_edge, from.end);
    const auto first = thread_work_[static_cast<std::size_t>(pair.thread)].rows.begin() + pair.first_row;
    kept.thread = 0;
    kept.first_row = static_cast<std::uint32_t>(state.rows.size());
    std::copy_if(first, first + pair.rows, std::back_inserter(state.rows),
                 [](const ContactRow& row) { return row.normal_impulse > 0; });
    kept.rows = static_cast<std::uint32_t>(state.rows.size()) - kept.first_row;
  }
  return state;
}

void SurfaceContact::restore(const State& state) {
  clear();
  traits_ = state.traits;
  bodies_ = state.bodies;
  search_.restore(state.features, state.history);
  pairs_ = state.pairs;
  cached_ = state.cached;
  thread_work_.resize(std::max(thread_work_.size(), std::size_t{1}));
  thread_work_[0].rows = state.rows;
  last_h_ = state.last_h;
}

std::size_t SurfaceContact::State::bytes() const {
  const auto of = [](const auto& list) { return list.size() * sizeof(list[0]); };
  return of(traits) + of(bodies) + of(history) + of(pairs) + of(features) + of(cached) + of(rows);
}

}  // namespace softbody

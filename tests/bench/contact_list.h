#pragma once
// What is left to do once a library has named a pair: decide whether it is a contact, and put the list in order.

#include <algorithm>
#include <vector>

#include "collide/core/detector.h"

namespace bench {

/// What boxes are padded by, in metres, so that two overlap where vertices in them are in contact: half of the
/// tolerance, and room for rounding.
inline float half_of(float tolerance) { return 0.50001f * tolerance; }

/// The project's definition of a contact, for the vertices of one frame.
class ContactFilter {
 public:
  /// The frame must stay alive.
  void begin(const collide::Frame& frame, const collide::Settings& settings) {
    frame_ = frame;
    tolerance2_ = settings.tolerance * settings.tolerance;
    self_collision_ = settings.self_collision;
    if (body_.size() == frame.x.size() && first_ == frame.bodies->first) return;
    first_ = frame.bodies->first;
    body_.resize(frame.x.size());
    for (collide::Index b = 0; b + 1 < first_.size(); ++b)
      for (collide::Index v = first_[b]; v < first_[b + 1]; ++v) body_[v] = b;
  }

  float tolerance2() const { return tolerance2_; }

  /// For a != b in any order.
  bool contact(collide::Index a, collide::Index b) const {
    const auto& [x, y, z, bodies] = frame_;
    return collide::squared_distance(x[a], y[a], z[a], x[b], y[b], z[b]) < tolerance2_ && allowed(a, b);
  }

  /// The part of it that is not the distance.
  bool allowed(collide::Index a, collide::Index b) const {
    if (body_[a] != body_[b]) return true;
    const collide::Index first = first_[body_[a]];
    return self_collision_ && !frame_.bodies->shape[body_[a]]->excludes(a - first, b - first, tolerance2_);
  }

 private:
  collide::Frame frame_;
  float tolerance2_ = 0;
  bool self_collision_ = true;
  std::vector<collide::Index> first_, body_;  // body_: of each vertex, made once for bodies that stay
};

/// Brings contacts into ascending order: a counting sort by the first vertex where that is faster than std::sort.
class ContactOrder {
 public:
  void sort(std::vector<collide::Contact>& contacts, std::size_t vertices) {
    if (contacts.size() < vertices / 16) return std::sort(contacts.begin(), contacts.end());
    end_.assign(vertices + 1, 0);
    for (const collide::Contact& c : contacts) ++end_[c.a + 1];
    for (std::size_t v = 0; v < vertices; ++v) end_[v + 1] += end_[v];
    sorted_.resize(contacts.size());
    for (const collide::Contact& c : contacts) sorted_[end_[c.a]++] = c;  // end_[a] runs from a's begin to its end
    auto from = sorted_.begin();
    for (auto to = from; from != sorted_.end(); from = to) {
      while (to != sorted_.end() && to->a == from->a) ++to;
      std::sort(from, to);
    }
    contacts.swap(sorted_);
  }

 private:
  std::vector<collide::Index> end_;
  std::vector<collide::Contact> sorted_;
};

}  // namespace bench

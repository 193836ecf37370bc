#pragma once
// Vertices in the order in which a method tests them.

#include "collide/core/frame.h"
#include "collide/core/workers.h"

namespace collide {

/// A run of slots of Points: [begin, end).
struct Range {
  Index begin, end;
  Index size() const { return end - begin; }
};

/// Structure of arrays: slot s holds the vertex vertex[s] of the body body[s]. Every array goes on for `padding` values
/// of no meaning, so that whole blocks can be read at the end.
struct Points {
  static constexpr Index padding = 16;
  std::vector<float> x, y, z;
  std::vector<Index> vertex, body;

  Index size() const { return size_; }
  void resize(Index count);
  void set(Index slot, const Frame& frame, Index of_vertex, Index of_body) {
    x[slot] = frame.x[of_vertex];
    y[slot] = frame.y[of_vertex];
    z[slot] = frame.z[of_vertex];
    vertex[slot] = of_vertex;
    body[slot] = of_body;
  }

  /// All vertices of the given bodies, in their order. ranges[k] becomes the slots of the body which[k].
  void gather(const Frame& frame, std::span<const Index> which, std::vector<Range>& ranges);

 private:
  Index size_ = 0;
};

/// The vertices of some bodies, numbered one after another.
class VertexList {
 public:
  VertexList(const Bodies& bodies, std::span<const Index> which);

  Index size() const { return first_.back(); }
  /// Calls visit(number, vertex, body) for a part of the vertices; ascending.
  template <class Visit>
  void for_each(Part part, const Visit& visit) const {
    auto number = static_cast<Index>(part.begin);
    for (auto k = static_cast<std::size_t>(std::upper_bound(first_.begin(), first_.end(), number) - first_.begin()) - 1;
         number < part.end; ++k) {
      const Index body = which_[k], first_vertex = bodies_->first[body] - first_[k];
      const Index end = std::min(first_[k + 1], static_cast<Index>(part.end));
      for (; number < end; ++number) visit(number, first_vertex + number, body);
    }
  }

 private:
  const Bodies* bodies_;
  std::span<const Index> which_;
  std::vector<Index> first_{0};  // the number of each body's first vertex
};

}  // namespace collide

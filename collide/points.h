#pragma once
// Vertices in the order in which a method tests them.

#include <cstring>

#include "collide/frame.h"

namespace collide {

/// A run of slots of Points: [begin, end).
struct Range {
  Index begin, end;
  Index size() const { return end - begin; }
};

/// Structure of arrays: a place in space for each slot. Every array goes on for `padding` values of no meaning, so that
/// whole blocks can be read at the end.
struct Places {
  static constexpr Index padding = 16;
  std::vector<float> x, y, z;

  Index size() const { return size_; }
  void resize(Index count);

  /// Copies a run of others behind the last one. There must be room: an earlier resize() to as many.
  void append(const Places& from, Range run) {
    constexpr Index block = padding / 2;  // runs are short, and a copy of constant size costs no call
    const auto copy = [](float* to, const float* begin) { std::memcpy(to, begin, block * sizeof(float)); };
    for (Index k = 0; k < run.size(); k += block) {
      copy(&x[size_ + k], &from.x[run.begin + k]);
      copy(&y[size_ + k], &from.y[run.begin + k]);
      copy(&z[size_ + k], &from.z[run.begin + k]);
    }
    size_ += run.size();
  }
  /// Drops those from `count` on, and keeps their room.
  void shrink(Index count) { size_ = count; }

 private:
  Index size_ = 0;
};

/// Slot s holds the vertex vertex[s] of the body body[s].
struct Points : Places {
  std::vector<Index> vertex, body;

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
};

}  // namespace collide

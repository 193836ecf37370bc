#pragma once
// The steps of the guided tour: one table, which the card and the tests loop over.

#include "app/render/highlight.h"
#include "app/ui/tour/findings.h"

namespace app {

/// What a step is about.
struct TourView {
  const softbody::World& world;
  const Findings& f;
  std::size_t corner;  // of f.corners

  const HashedCorner& chosen() const { return f.corners[corner]; }
};

struct TourFigure {
  std::string label, value, tooltip;
  std::optional<glm::vec3> colour{};  // of it in the scene
};

struct TourStep {
  std::string_view title;  // with its section of the paper
  std::string_view text;
  std::vector<TourFigure> (*figures)(const TourView& view);
  void (*show)(const TourView& view, Highlight& light);
  bool corners = false;  // one of the box's corners can be chosen
};

std::span<const TourStep> tour_steps();

/// Hashes, boxes and pair tests of the paper's method on this frame, beside what §3 claims of them.
std::vector<TourFigure> tour_work(const TourView& view);

}  // namespace app

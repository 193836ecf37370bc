#pragma once
// The steps of the guided tour: one table for the tour's window and the tests.

#include "app/render/highlight.h"
#include "app/ui/tour/example.h"

namespace app::ui {

/// What the figures and highlights of a step are made from.
struct TourContext {
  const softbody::World& world;
  const TourExample& f;
  std::size_t corner;  // of f.corners

  const HashedCorner& chosen() const { return f.corners[corner]; }
};

struct TourFigure {
  std::string label, value, tooltip;
  std::optional<glm::vec3> colour{};  // in the scene
};

struct TourStep {
  std::string_view title;  // with its section of the paper
  std::string_view text;
  std::vector<TourFigure> (*figures)(const TourContext& context);
  void (*highlight)(const TourContext& context, render::Highlight& highlight);
  bool corners = false;  // the user can choose a corner of the box
};

std::span<const TourStep> tour_steps();

}  // namespace app::ui

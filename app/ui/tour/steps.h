#pragma once
// The steps of the guided tour: one table for the tour's window and the tests.

#include <span>

#include "app/render/highlight.h"
#include "app/ui/tour/example.h"

namespace app::ui {

/// What the texts, figures and highlights of a step are made from.
struct TourContext {
  const softbody::BodiesInMotion& world;
  const TourExample& f;
  std::optional<std::size_t> chosen;  // by the user, of f.corners

  /// The corner whose hash is shown.
  const HashedCorner& hashed_corner() const { return f.corners[chosen.value_or(f.corner)]; }
  /// The corner whose bucket is shown.
  const HashedCorner& bucket_corner() const {
    return f.aliased_corner && !chosen ? *f.aliased_corner : hashed_corner();
  }
  /// Returns the contents of this bucket. The group of the corner's own cell comes first.
  compare::BucketContents bucket() const;
  /// Returns the groups of bucket() that are listed and drawn.
  static std::span<const compare::CellGroup> shown_cells(const compare::BucketContents& bucket) {
    constexpr std::size_t max_shown = 3;
    return std::span(bucket.groups).first(std::min(max_shown, bucket.groups.size()));
  }
};

struct TourFigure {
  std::string label, value, tooltip;
  std::optional<glm::vec3> colour{};  // in the scene
};

/// What the example of a step should have. The tour runs the world ahead to a frame that has it.
struct TourGoal {
  std::string_view lacking;  // a sentence: the frame does not have it
  std::string_view running;  // the beginning of a sentence that ends with the number of the frame
  std::string_view button;
  bool (ExampleFinder::*frame_has)(const softbody::BodiesInMotion& world);
  bool (*example_has)(const TourExample& example);
};

struct TourStep {
  std::string_view title;  // with its section of the paper
  std::string (*text)(const TourContext& context);
  std::vector<TourFigure> (*figures)(const TourContext& context);
  void (*highlight)(const TourContext& context, render::Highlight& highlight);
  const TourGoal& goal;
  /// The corner that the step shows, where the user can choose one.
  const HashedCorner& (TourContext::*corner)() const = nullptr;
};

std::span<const TourStep> tour_steps();

// The figures of each step.
std::vector<TourFigure> figures_of_body(const TourContext& context);
std::vector<TourFigure> figures_of_boxes(const TourContext& context);
std::vector<TourFigure> figures_of_corner(const TourContext& context);  // the hash function with the corner's numbers
std::vector<TourFigure> figures_of_bucket(const TourContext& context);
std::vector<TourFigure> figures_of_contact(const TourContext& context);
std::vector<TourFigure> figures_of_miss(const TourContext& context);
/// Hashes, boxes and pair tests of the paper's method on a frame, beside the claims of §3.
std::vector<TourFigure> figures_of_frame(const FrameWork& work);

// What each step highlights in the scene.
void highlight_body(const TourContext& context, render::Highlight& highlight);
void highlight_boxes(const TourContext& context, render::Highlight& highlight);
void highlight_corners(const TourContext& context, render::Highlight& highlight);
void highlight_bucket(const TourContext& context, render::Highlight& highlight);
void highlight_contact(const TourContext& context, render::Highlight& highlight);
void highlight_miss(const TourContext& context, render::Highlight& highlight);

/// The step that explains a missed contact.
inline constexpr std::size_t miss_step = 5;

}  // namespace app::ui

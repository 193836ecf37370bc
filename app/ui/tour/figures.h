#pragma once
// The figures that the guided tour shows: those of each step, and those of the whole frame.

#include "app/ui/tour/steps.h"

namespace app::ui {

std::vector<TourFigure> figures_of_body(const TourContext& context);
std::vector<TourFigure> figures_of_boxes(const TourContext& context);
std::vector<TourFigure> figures_of_corner(const TourContext& context);  // the hash function with the corner's numbers
std::vector<TourFigure> figures_of_bucket(const TourContext& context);
std::vector<TourFigure> figures_of_contact(const TourContext& context);
std::vector<TourFigure> figures_of_miss(const TourContext& context);

/// Hashes, boxes and pair tests of the paper's method on a frame, beside the claims of §3.
std::vector<TourFigure> figures_of_frame(const FrameWork& work);

}  // namespace app::ui

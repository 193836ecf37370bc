#pragma once
// The numbers of each step of the guided tour.

#include "app/ui/tour/steps.h"

namespace app {

std::vector<TourFigure> figures_of_body(const TourView& view);
std::vector<TourFigure> figures_of_boxes(const TourView& view);
std::vector<TourFigure> figures_of_corner(const TourView& view);  // the hash function with the corner's numbers
std::vector<TourFigure> figures_of_bucket(const TourView& view);
std::vector<TourFigure> figures_of_contact(const TourView& view);

}  // namespace app

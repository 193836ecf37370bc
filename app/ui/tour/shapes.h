#pragma once
// What each step of the guided tour shows in the scene.

#include "app/ui/tour/steps.h"

namespace app {

void show_body(const TourView& view, Highlight& light);
void show_boxes(const TourView& view, Highlight& light);
void show_corners(const TourView& view, Highlight& light);
void show_bucket(const TourView& view, Highlight& light);
void show_contact(const TourView& view, Highlight& light);

}  // namespace app

#pragma once
// What each step of the guided tour highlights in the scene.

#include "app/ui/tour/steps.h"

namespace app::ui {

void highlight_body(const TourContext& context, render::Highlight& highlight);
void highlight_boxes(const TourContext& context, render::Highlight& highlight);
void highlight_corners(const TourContext& context, render::Highlight& highlight);
void highlight_bucket(const TourContext& context, render::Highlight& highlight);
void highlight_contact(const TourContext& context, render::Highlight& highlight);
void highlight_miss(const TourContext& context, render::Highlight& highlight);

}  // namespace app::ui

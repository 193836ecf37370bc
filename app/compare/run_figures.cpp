#include "app/compare/run_figures.h"

#include <algorithm>
#include <cassert>

namespace app::compare {

void RunFigures::add(const softbody::BodiesInMotion& world) {
  assert(totals().frames == 0 || world.frame() > totals().frame);
  const std::vector<collide::Contact>& found = world.detection().contacts;
  RunTotals next = totals();
  if (world.method().exact) {
    missed_.clear();
    next.true_contacts += found.size();
  } else {
    if (!exact_) exact_ = collide::find_method(collide::default_method)->make();
    exact_->detect(world.positions(), world.collision(), alone_, truth_);
    missed_ = score(found, truth_.contacts).missed;
    next.true_contacts += truth_.contacts.size();
    next.missed += missed_.size();
  }
  next.frame = world.frame();
  ++next.frames;
  next.detect_ms += world.last_step().detect_ms;
  totals_.push_back(next);
}

void RunFigures::add(const collide::oracle::SurfaceFigures& figures) {
  RunTotals& last = totals_.back();
  last.inside = figures.penetrating_vertices;
  last.depth = figures.deepest;
  last.most_inside = std::max(last.most_inside, last.inside);
  last.deepest = std::max(last.deepest, last.depth);
}

void RunFigures::go_back(int frame) {
  missed_.clear();
  while (totals_.size() > 1 && totals().frame > frame) totals_.pop_back();
}

}  // namespace app::compare

#include "app/compare/surface_check.h"

#include <array>
#include <utility>

#include "app/base/text.h"

namespace app::compare {
namespace {

glm::vec3 from_vertex(const softbody::ConstPoints& at, collide::Index v, const glm::dvec3& point) {
  return glm::vec3(point - glm::dvec3(at[v]));
}

std::vector<SurfaceMark> marks_of(const Positions& at, const collide::oracle::Overlaps& overlaps,
                                  const collide::oracle::Missed& missed) {
  std::vector<SurfaceMark> marks;
  for (const std::size_t i : missed.penetrations) {
    const collide::oracle::Penetration& in = overlaps.penetrations[i];
    marks.push_back({in.vertex, from_vertex(at, in.vertex, in.point), false, in.body});
  }
  for (const std::size_t i : missed.piercings) {
    const collide::oracle::Piercing& through = overlaps.piercings[i];
    marks.push_back({through.edge[0], from_vertex(at, through.edge[0], through.point), true, through.triangle_body});
  }
  return marks;
}

}  // namespace

std::optional<SurfaceReport> SurfaceCheck::advance(const StepSnapshot& step,
                                                   const Background<SurfaceCheck>& background) {
  SurfaceReport report;
  report.id = step.id;
  report.frame = step.frame;
  try {
    collide::Workers worker(1);
    const collide::Frame now = step.view();
    if (!overlaps_) {
      overlaps_ = collide::oracle::find_overlaps(now, step.surfaces, worker);
      return std::nullopt;
    }
    const collide::oracle::Overlaps overlaps = *std::exchange(overlaps_, std::nullopt);
    if (background.cancelled()) return report;
    Positions start = step.before;
    for (std::size_t v = start.x.size(); v < step.at.x.size(); ++v)  // bodies that were added in the step
      start.add(std::array{glm::dvec3(softbody::ConstPoints(step.at)[v])});
    const collide::Frame before{start.x, start.y, start.z, &step.bodies};
    const auto crossings = collide::oracle::find_crossings(before, now, step.surfaces, worker);
    report.figures = collide::oracle::figures_of(now, overlaps, crossings);
    const collide::oracle::Missed missed = collide::oracle::missed_by(step.contacts, now, step.surfaces, overlaps);
    report.penetrations = overlaps.penetrations.size();
    report.missed_penetrations = missed.penetrations.size();
    report.missed_piercings = missed.piercings.size();
    report.missed_pairs = missed.pairs.size();
    report.marks = marks_of(step.at, overlaps, missed);
  } catch (const std::exception& error) {
    report.failure = failure_text(error);
  }
  return report;
}

}  // namespace app::compare

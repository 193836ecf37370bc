// The figures of the guided tour: those of each step, and those of the whole frame.

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include <fmt/core.h>
#include <glm/common.hpp>

#include "app/base/text.h"
#include "app/render/palette.h"
#include "app/ui/tour/steps.h"

namespace app::ui {
namespace {

std::string metres(float length) { return fmt::format("{:.3f} m", length); }
std::string place(const glm::vec3& p) { return fmt::format("({:.3f}, {:.3f}, {:.3f})", p.x, p.y, p.z); }
std::string sides(const glm::vec3& s) { return fmt::format("{:.3f} x {:.3f} x {:.3f} m", s.x, s.y, s.z); }

TourFigure body_figure(const char* label, const softbody::BodiesInMotion& world, softbody::BodyId body) {
  return {label, std::to_string(body), "Bodies count from 0. A selected body is taken if it touches another.",
          render::body_colour(world.body(body).number)};
}

std::vector<TourFigure> hash_terms(const TourContext& v) {
  constexpr std::array axes{"x", "y", "z"};
  const collide::Settings& settings = v.world.collision();
  const HashedCorner& corner = v.hashed_corner();
  std::vector<TourFigure> figures;
  std::int64_t sum = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const auto a = static_cast<std::size_t>(axis);
    const std::int64_t index = corner.cell[a];
    sum += index * settings.primes[a];
    figures.push_back({fmt::format("{}: floor({:.3f} / {:.3f})", axes[a], corner.at[axis], (*settings.cell_size)[axis]),
                       fmt::format("{} * {}", index, settings.primes[a]),
                       fmt::format("Along {}: the corner over the cell's side, rounded down, times {}prime (§2.2).",
                                   axes[a], axes[a])});
  }
  figures.push_back({fmt::format("The sum % {}", grouped(settings.buckets)),
                     fmt::format("{}{}  ->  {}", sum < 0 ? "-" : "", grouped(static_cast<std::uint64_t>(std::abs(sum))),
                                 grouped(corner.bucket)),
                     "Modulo the number of buckets, the paper's bucket size; wrapped so that it is never negative."});
  return figures;
}

/// True if the terms of the hash fit their sum; corners that fail are kilometres away.
bool can_be_written_out(const HashedCorner& corner) {
  constexpr std::int64_t max_index = 500'000'000;
  return std::ranges::all_of(corner.cell, [](std::int64_t index) { return std::abs(index) < max_index; });
}

}  // namespace

std::vector<TourFigure> figures_of_body(const TourContext& v) {
  const auto& [lo, hi] = v.f.bounds[0];
  const collide::Bodies& bodies = v.world.bodies();
  return {body_figure("Body", v.world, v.f.body),
          {"Its vertices", grouped(bodies.size(v.f.body)), "The method looks at each of them once, to find the box."},
          {"Minimum point", place(lo), "In metres: the smallest x, y and z of its vertices."},
          {"Maximum point", place(hi), "In metres: the largest x, y and z of its vertices."},
          {"Sides", sides(hi - lo), "The sides of the box: the maximum point less the minimum point."}};
}

std::vector<TourFigure> figures_of_boxes(const TourContext& v) {
  const auto& [lo, hi, body] = v.f.structure.boxes[v.f.boxes.begin];
  const glm::vec3 side = hi - lo, cell = *v.world.collision().cell_size;
  const bool fits = glm::min(side, cell) == side;
  const int levels = v.world.collision().levels;
  return {
      body_figure("Body", v.world, v.f.body),
      {"n, the level of subdivision", fmt::format("{}: 2^n = {}", levels, grouped(1ull << levels)),
       "Set it in the panel, or by [ and ]. The paper uses 3."},
      {"Boxes with vertices", grouped(v.f.boxes.size()), "The boxes of this body. Boxes without vertices are dropped."},
      {"A box", sides(side), "All boxes of a body have the same sides, but for rounding."},
      {"A cell", sides(cell),
       fmt::format("The side of a grid cell. {}",
                   fits ? "The box fits into it, so that its corners reach every cell that it overlaps: amber."
                        : "The box is larger, so that its corners skip cells in between: red.")}};
}

std::vector<TourFigure> figures_of_corner(const TourContext& v) {
  const HashedCorner& corner = v.hashed_corner();
  std::vector<TourFigure> figures{
      {fmt::format("Corner {}", v.chosen.value_or(v.f.corner) + 1), fmt::format("{} m", place(corner.at)),
       "A corner of the box that is nearest to the other body. Choose another corner above."}};
  if (!can_be_written_out(corner)) {
    figures.push_back({"Bucket", grouped(corner.bucket), "The corner is too far away to write its numbers out."});
    return figures;
  }
  for (TourFigure& figure : hash_terms(v)) figures.push_back(std::move(figure));
  return figures;
}

std::vector<TourFigure> figures_of_bucket(const TourContext& v) {
  const compare::BucketContents bucket = v.bucket();
  std::vector<TourFigure> figures{
      {fmt::format("Bucket {}", grouped(bucket.bucket)),
       fmt::format("{}{}{}{}", grouped(bucket.items), bucket.items == 1 ? " box, " : " boxes, ",
                   grouped(bucket.groups.size()), bucket.groups.size() == 1 ? " cell" : " cells"),
       "The boxes with a corner in this bucket, and the cells of these corners."}};
  for (const compare::CellGroup& group : TourContext::shown_cells(bucket))
    figures.push_back({fmt::format("Cell {}", compare::cell_text(group.cell)),
                       bodies_text(group, bucket, v.f.structure, {}),
                       fmt::format("Boxes with a corner in this cell: {}.", grouped(group.items.size())),
                       &group == &bucket.groups.front() ? render::same_cell_colour : render::aliased_colour});
  if (const std::size_t shown = TourContext::shown_cells(bucket).size(); shown < bucket.groups.size())
    figures.push_back({"Cells not shown", grouped(bucket.groups.size() - shown),
                       "Other cells of this bucket, each with no more boxes than those in orange."});
  figures.push_back({"Pairs in this bucket", sharing_text(bucket.sharing),
                     "Pairs of boxes that the bucket brings together: near ones of the same cell, and those of other "
                     "cells, by the modulo alone (aliasing)."});
  figures.push_back({"In all buckets", sharing_text(v.f.table.sharing()), "The same, summed over all buckets."});
  return figures;
}

std::vector<TourFigure> figures_of_contact(const TourContext& v) {
  const float tolerance = v.world.collision().tolerance;
  const bool self = v.f.body == v.f.other;
  std::vector<TourFigure> figures{body_figure(self ? "Within body" : "Body", v.world, v.f.body)};
  if (!self) figures.push_back(body_figure("Nearest to it", v.world, v.f.other));
  figures.push_back(
      {"Closest vertices", v.f.closest ? metres(v.f.distance) : "-", "The distance d of these two vertices."});
  figures.push_back(
      {"Tolerance", metres(tolerance), "Two vertices whose distance d is below it are a contact (§2.3)."});
  if (!v.f.touching) {
    figures.push_back({"Contacts", "none", "These bodies do not touch in this frame."});
    return figures;
  }
  figures.push_back({self ? "Its contacts with itself" : "Contacts of the two", grouped(v.f.contacts.size()),
                     "The number of all contacts, found by an exact method.",
                     self ? render::contact_inside_colour : render::contact_between_colour});
  figures.push_back(
      {"Missed", grouped(v.f.missed.size()),
       "The contacts that the paper's method does not find: the boxes of their two vertices share no bucket.",
       render::contact_missed_colour});
  return figures;
}

std::vector<TourFigure> figures_of_miss(const TourContext& v) {
  std::vector<TourFigure> figures;
  if (const auto& miss = v.f.miss) {
    for (std::size_t i = 0; i < 2; ++i)
      figures.push_back({fmt::format("Body {}, cell {}", miss->bodies[i], compare::cell_text(miss->corners[i].cell)),
                         fmt::format("bucket {}", grouped(miss->corners[i].bucket)),
                         "The box of one of the two vertices. Of its eight corners, this one's cell is the nearest to "
                         "the cells of the other box.",
                         render::body_colour(v.world.body(miss->bodies[i]).number)});
    if (miss->face)
      figures.push_back(
          {"Cell face between the boxes",
           fmt::format(
               "{} = {}", "xyz"[miss->face->axis],
               metres(static_cast<float>(miss->face->index) * (*v.world.collision().cell_size)[miss->face->axis])),
           "The corners of one box are in cells below it, those of the other in cells above it.", render::cell_colour});
    else
      figures.push_back({"Skipped cell", compare::cell_text(*miss->skipped),
                         "Both boxes reach over this cell, but at least one of them has no corner in it.",
                         render::cell_colour});
    figures.push_back({"Tolerance", metres(v.world.collision().tolerance), "Closer vertices are a contact (§2.3)."});
  }
  figures.push_back(
      {"Contacts of the frame", grouped(v.f.all_contacts), "The number of all contacts, found by an exact method."});
  figures.push_back({"Missed by the paper's method", grouped(v.f.all_missed),
                     "The contacts that it does not find with the levels, cells and buckets in use.",
                     render::contact_missed_colour});
  return figures;
}

std::vector<TourFigure> figures_of_frame(const FrameWork& work) {
  return {
      {"Boxes / bodies", fmt::format("{} / {}", grouped(work.boxes), grouped(work.bodies)),
       "All subdivided boxes with vertices, in the whole frame."},
      {"Hashes / vertices", fmt::format("{} / {}", grouped(work.hashes), grouped(work.vertices)),
       fmt::format("There are 8 corners per box, against one hash per vertex without boxes: {} per vertex. §3 claims "
                   "that boxes save hashes; they do while a box holds more than 8 vertices. Both grow with the number "
                   "of bodies.",
                   ratio(work.hashes, work.vertices))},
      {work.pair_tests_estimated ? "Pair tests, estimated" : "Pair tests", grouped(work.pair_tests),
       fmt::format("The method makes {} per vertex. §3 claims O(1) at best, which is so many per vertex however many "
                   "bodies there are, and O(N^2), all pairs, at worst.",
                   ratio(work.pair_tests, work.vertices))},
      {"All pairs", grouped(work.all_pairs), "The pair tests of a method without boxes and hashes (brute force)."}};
}

}  // namespace app::ui

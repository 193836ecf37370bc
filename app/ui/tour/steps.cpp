#include "app/ui/tour/steps.h"

#include <algorithm>
#include <cassert>

#include <fmt/core.h>
#include <glm/geometric.hpp>

namespace app::ui {
namespace {

constexpr TourGoal contact_goal{.lacking = "Nothing touches in this frame.",
                                .running = "Nothing touches yet: running ahead to the first contact",
                                .button = "Run ahead to a contact",
                                .frame_has = &ExampleFinder::has_contact,
                                .example_has = [](const TourExample& example) { return example.touching; }};

constexpr TourGoal miss_goal{.lacking = "The paper's method misses nothing in this frame.",
                             .running = "The paper's method misses nothing yet: running ahead to the first miss",
                             .button = "Run ahead to a miss",
                             .frame_has = &ExampleFinder::has_miss,
                             .example_has = [](const TourExample& example) { return example.miss.has_value(); }};

std::string text_of_body(const TourContext&) {
  return "Every frame begins with the bounding box of each body: the smallest and the largest x, y and z of its "
         "vertices. From here on, six numbers stand for all vertices.";
}

std::string text_of_boxes(const TourContext&) {
  return "The box is cut in the middle along x, y and z in turn, n times. Each vertex is in one of the parts. Empty "
         "parts are dropped. The keys [ and ] change n.";
}

std::string text_of_corner(const TourContext&) {
  return "A grid fills space. Three primes and a modulo turn the cell of a corner point into the number of a bucket. "
         "The box joins the list of this bucket. All eight corners are hashed, however many vertices the box holds.";
}

std::string text_of_bucket(const TourContext& v) {
  std::string text =
      "Boxes in one bucket may touch, so their vertices are compared. Boxes of the same cell (blue) are real "
      "neighbours. ";
  if (v.bucket().groups.size() == 1)
    return text +
           "No other cell has this bucket's number in this frame. It could happen: there are more cells than buckets, "
           "so the modulo gives some cells the same number.";
  text +=
      "Boxes of another cell (orange) are here only because the modulo gave both cells the same number. They cost "
      "pair tests and are not near.";
  if (v.f.aliased_corner && !v.chosen)
    text += " The box of the page before shares no bucket with another cell, so this is the bucket of another box.";
  return text;
}

std::string text_of_contact(const TourContext&) {
  return "Vertices of boxes that share a bucket are compared. Two that are closer than the tolerance collide, between "
         "bodies and within one. Boxes that share no bucket are never compared, so a contact between them is missed.";
}

std::string text_of_miss(const TourContext& v) {
  if (!v.f.miss)
    return "A contact is missed if the boxes of its two vertices share no bucket. This happens where a cell face lies "
           "between two boxes, or where the corners of a large box skip a cell. Smaller cells and more boxes (the key "
           "]) make it more likely.";
  const ExplainedMiss& miss = *v.f.miss;
  return fmt::format(
      "The vertices are {:.3f} m apart, but {}. No cell has corners of both boxes, and no bucket has both boxes, "
      "so the pair is never compared.\n\n"
      "The complete methods find this contact. Multi-Level SB, complete, puts each box, padded by half the tolerance, "
      "into all cells that it overlaps. Grid Hash looks into all cells within the tolerance. The exact method uses no "
      "hash: boxes that are closer than the tolerance count as near.",
      glm::distance(miss.at[0], miss.at[1]),
      miss.face ? "a cell face (dark blue) lies between their boxes"
                : "a box is larger than a cell, and its corners skip a cell that both boxes reach over (dark blue)");
}

constexpr std::array step_table{
    TourStep{"A box round each body (§2.1)", text_of_body, figures_of_body, highlight_body, contact_goal},
    TourStep{"Cut into 2^n boxes (§2.1)", text_of_boxes, figures_of_boxes, highlight_boxes, contact_goal},
    TourStep{"Corners into buckets (§2.2)", text_of_corner, figures_of_corner, highlight_corners, contact_goal,
             &TourContext::hashed_corner},
    TourStep{"One bucket (§2.2)", text_of_bucket, figures_of_bucket, highlight_bucket, contact_goal,
             &TourContext::bucket_corner},
    TourStep{"The contact surface (§2.3, §2.4)", text_of_contact, figures_of_contact, highlight_contact, contact_goal},
    TourStep{"A miss (§2.2)", text_of_miss, figures_of_miss, highlight_miss, miss_goal},
};
static_assert(step_table.size() == miss_step + 1);

}  // namespace

compare::BucketContents TourContext::bucket() const {
  compare::BucketContents bucket = f.table.bucket(bucket_corner().bucket);
  const auto own = std::ranges::find(bucket.groups, bucket_corner().cell, &compare::CellGroup::cell);
  assert(own != bucket.groups.end());
  std::rotate(bucket.groups.begin(), own, std::next(own));
  return bucket;
}

std::span<const TourStep> tour_steps() { return step_table; }

}  // namespace app::ui

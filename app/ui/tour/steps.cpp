#include "app/ui/tour/steps.h"

#include "app/ui/tour/figures.h"
#include "app/ui/tour/highlights.h"

namespace app::ui {
namespace {

constexpr std::array step_table{
    TourStep{"A box round each body (§2.1)",
             "Every frame begins with a body's axis-aligned bounding box: the least and the greatest x, y and z of its "
             "vertices. From here on a few numbers stand for all of them.",
             figures_of_body, highlight_body},
    TourStep{
        "Cut into 2^n boxes (§2.1)",
        "The box is cut in the middle along x, y and z in turn, n times. Each vertex is in one of the parts; empty "
        "parts are dropped. The keys [ and ] change n.",
        figures_of_boxes, highlight_boxes},
    TourStep{"Corners into buckets (§2.2)",
             "A grid fills space. The cell that a corner point lies in becomes a number by three primes, modulo the "
             "number of buckets: the box joins this bucket's list. So do all eight corners, however many vertices the "
             "box holds.",
             figures_of_corner, highlight_corners, true},
    TourStep{"One bucket (§2.2)",
             "Boxes in one bucket may touch. Those in the same cell really are neighbours (blue). Boxes of another "
             "cell are here only because the modulo gave both cells one number (orange): that costs tests and "
             "finds nothing near.",
             figures_of_bucket, highlight_bucket, true},
    TourStep{
        "The contact surface (§2.3, §2.4)",
        "Vertices of boxes that share a bucket are compared. Two that are closer than the tolerance collide: it is "
        "a shield round the surface, between bodies and within one. What shares no bucket is never compared, and "
        "missed.",
        figures_of_contact, highlight_contact},
};

}  // namespace

std::span<const TourStep> tour_steps() { return step_table; }

}  // namespace app::ui

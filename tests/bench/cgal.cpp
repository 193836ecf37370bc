// CGAL: box_self_intersection_d, a hybrid of segment trees and scans, over the boxes of all patches in every frame.

#include <CGAL/Box_intersection_d/Box_with_info_d.h>
#include <CGAL/box_intersection_d.h>

#include "tests/bench/candidate.h"
#include "tests/bench/patches.h"

namespace bench {
namespace {

class Cgal final : public collide::Detector {
 public:
  void detect(const collide::Frame& frame, const collide::Settings& settings, collide::Workers&,
              collide::Result& result) override {
    result = {};
    filter_.begin(frame, settings);
    patches_.update(frame, settings.tolerance);
    patches_.test_insides(filter_, result.contacts);
    boxes_.clear();
    for (collide::Index p = 0; p < patches_.count(); ++p) {
      Box box = patches_.box(p);  // CGAL asks for what it might change
      boxes_.emplace_back(box.lo.data(), box.hi.data(), p);
    }
    CGAL::box_self_intersection_d(
        boxes_.begin(), boxes_.end(),
        [&](const PatchBox& a, const PatchBox& b) { patches_.test(a.info(), b.info(), filter_, result.contacts); },
        cutoff);
    order_.sort(result.contacts, frame.x.size());
  }

 private:
  static constexpr std::ptrdiff_t cutoff = 500;  // boxes; below it CGAL scans. Of 5 to 2000 the fastest
  using PatchBox =
      CGAL::Box_intersection_d::Box_with_info_d<float, 3, collide::Index, CGAL::Box_intersection_d::ID_EXPLICIT>;

  Patches<16> patches_;
  ContactFilter filter_;
  std::vector<PatchBox> boxes_;
  ContactOrder order_;
};

}  // namespace

std::unique_ptr<collide::Detector> make_cgal() { return std::make_unique<Cgal>(); }

}  // namespace bench

// Bullet: a btDbvt over the patches of each body, as its soft bodies have, and one over the bodies.

#include <BulletCollision/BroadphaseCollision/btDbvt.h>

#include "tests/bench/candidate.h"
#include "tests/bench/patches.h"

namespace bench {
namespace {

using collide::Index;

btVector3 vector(const std::array<float, 3>& v) { return {v[0], v[1], v[2]}; }
void* pack(Index value) { return reinterpret_cast<void*>(std::uintptr_t{value}); }
Index unpack(const btDbvtNode* leaf) { return static_cast<Index>(reinterpret_cast<std::uintptr_t>(leaf->data)); }

template <class Function>
struct Policy final : btDbvt::ICollide {
  explicit Policy(Function f) : function(std::move(f)) {}
  void Process(const btDbvtNode* a, const btDbvtNode* b) override { function(a, b); }
  Function function;
};

class Bullet final : public collide::Detector {
 public:
  void detect(const collide::Frame& frame, const collide::Settings& settings, collide::Workers&,
              collide::Result& result) override {
    result = {};
    filter_.begin(frame, settings);
    patches_.update(frame, settings.tolerance);
    update(frame);
    Policy patches([&](const btDbvtNode* a, const btDbvtNode* b) {
      patches_.test(unpack(a), unpack(b), filter_, result.contacts);
    });
    patches_.test_insides(filter_, result.contacts);
    for (const auto& tree : trees_) world_.collideTTpersistentStack(tree->m_root, tree->m_root, patches);
    Policy bodies([&](const btDbvtNode* a, const btDbvtNode* b) {
      trees_.front()->collideTTpersistentStack(trees_[unpack(a)]->m_root, trees_[unpack(b)]->m_root, patches);
    });
    world_.collideTT(world_.m_root, world_.m_root, bodies);
    order_.sort(result.contacts, frame.x.size());
  }

 private:
  btDbvtVolume volume(Index patch) const {
    const auto& [lo, hi] = patches_.box(patch);
    return btDbvtVolume::FromMM(vector(lo), vector(hi));
  }

  /// Trees made once for bodies that stay; afterwards their boxes follow.
  void update(const collide::Frame& frame) {
    if (first_ != frame.bodies->first) return start(frame);
    for (Index b = 0; b < trees_.size(); ++b) {
      refit(trees_[b]->m_root);
      world_.update(bodies_[b], trees_[b]->m_root->volume);
    }
  }

  void start(const collide::Frame& frame) {
    first_ = frame.bodies->first;
    world_.clear();
    trees_.clear();
    bodies_.clear();
    Index p = 0;
    for (Index b = 0; b + 1 < first_.size(); ++b) {
      auto& tree = *trees_.emplace_back(std::make_unique<btDbvt>());
      for (; p < patches_.count() && patches_.body(p) == b; ++p) tree.insert(volume(p), pack(p));
      tree.optimizeTopDown();
      bodies_.push_back(world_.insert(tree.m_root->volume, pack(b)));
    }
    world_.optimizeTopDown();
  }

  void refit(btDbvtNode* node) const {
    if (node->isleaf()) {
      node->volume = volume(unpack(node));
      return;
    }
    refit(node->childs[0]);
    refit(node->childs[1]);
    Merge(node->childs[0]->volume, node->childs[1]->volume, node->volume);
  }

  Patches<16> patches_;
  std::vector<Index> first_;
  std::vector<std::unique_ptr<btDbvt>> trees_;  // of patches, one a body
  btDbvt world_;                                // of bodies
  std::vector<btDbvtNode*> bodies_;             // the leaves of world_
  ContactFilter filter_;
  ContactOrder order_;
};

}  // namespace

std::unique_ptr<collide::Detector> make_bullet() { return std::make_unique<Bullet>(); }

}  // namespace bench

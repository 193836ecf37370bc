#include "softbody/integrate/implicit/matrices.h"

#include <algorithm>
#include <cassert>
#include <utility>

namespace softbody {

void ImplicitMatrices::prepare(const BodyModel& model, double h) {
  if (const auto known = std::ranges::find(entries_, h, &Entry::h); known != entries_.end()) {
    std::rotate(known, known + 1, entries_.end());
    return;
  }
  auto matrix = std::make_unique<const ImplicitMatrix>(model, h, entries_.empty() ? nullptr : entries_[0].matrix.get());
  if (entries_.size() >= max_lengths) entries_.erase(entries_.begin());
  entries_.push_back({h, std::move(matrix)});
}

const ImplicitMatrix& ImplicitMatrices::at(double h) const {
  const auto found = std::ranges::find(entries_, h, &Entry::h);
  assert(found != entries_.end());
  return *found->matrix;
}

}  // namespace softbody

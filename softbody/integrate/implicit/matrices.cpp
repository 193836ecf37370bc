#include "softbody/integrate/implicit/matrices.h"

#include <algorithm>
#include <cassert>

namespace softbody {

void ImplicitMatrices::retain(const std::function<bool(const BodyModel&)>& in_use) {
  std::erase_if(entries_, [&](const Entry& e) { return !in_use(*e.model); });
}

void ImplicitMatrices::prepare(const std::shared_ptr<const BodyModel>& model, double h) {
  const auto of_model = [&](const Entry& e) { return e.model == model; };
  const auto known = std::ranges::find_if(entries_, [&](const Entry& e) { return of_model(e) && e.h == h; });
  if (known != entries_.end()) {
    std::rotate(known, known + 1, entries_.end());
    return;
  }
  const auto oldest = std::ranges::find_if(entries_, of_model);
  auto matrix =
      std::make_shared<const ImplicitMatrix>(*model, h, oldest == entries_.end() ? nullptr : oldest->matrix.get());
  if (std::ranges::count_if(entries_, of_model) >= std::ptrdiff_t(max_lengths)) entries_.erase(oldest);
  entries_.push_back({model, h, std::move(matrix)});
}

const ImplicitMatrix& ImplicitMatrices::at(const BodyModel& model, double h) const {
  const auto found =
      std::ranges::find_if(entries_, [&](const Entry& e) { return e.model.get() == &model && e.h == h; });
  assert(found != entries_.end());
  return *found->matrix;
}

}  // namespace softbody

#include "app/reference/shield_account.h"

#include <algorithm>

namespace app {
namespace {

const collide::Contact& contact_of(const softbody::PairEnergy& p) { return p.contact; }

/// The one of this contact in a list that ascends; nothing: it is not there.
template <class List, class Projection>
auto find(const List& list, const collide::Contact& contact, Projection of) -> decltype(&*list.begin()) {
  const auto at = std::ranges::lower_bound(list, contact, {}, of);
  return at != list.end() && of(*at) == contact ? &*at : nullptr;
}

}  // namespace

ShieldAccount::ShieldAccount(std::span<const softbody::PairEnergy> found) {
  for (const softbody::PairEnergy& p : found) entries_.push_back({p, p.joules});
}

void ShieldAccount::frame(std::span<const softbody::PairEnergy> ended, std::span<const softbody::PairEnergy> found) {
  std::vector<Entry> now;
  for (const softbody::PairEnergy& p : found) {
    Entry& entry = now.emplace_back(Entry{p, 0});
    const Entry* before = find(entries_, p.contact, [](const Entry& e) { return e.found.contact; });
    const softbody::PairEnergy* end = find(ended, p.contact, contact_of);
    if (before && end) entry.stored = std::clamp(before->stored + end->joules - before->found.joules, 0.0, p.joules);
  }
  entries_ = std::move(now);
}

double ShieldAccount::stored() const {
  double sum = 0;
  for (const Entry& e : entries_) sum += e.stored;
  return sum;
}

}  // namespace app

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

ShieldAccount::ShieldAccount(std::span<const softbody::PairEnergy> found, std::size_t vertices) : vertices_(vertices) {
  for (const softbody::PairEnergy& p : found) entries_.push_back({p, p.joules});
}

double ShieldAccount::frame(std::span<const softbody::PairEnergy> ended, std::span<const softbody::PairEnergy> found,
                            std::size_t vertices) {
  std::vector<Entry> now;
  double brought = 0;
  for (const softbody::PairEnergy& p : found) {
    Entry& entry = now.emplace_back(Entry{p, 0});
    if (p.contact.b >= vertices_) {
      entry.stored = p.joules;
      brought += p.joules;
      continue;
    }
    const Entry* before = find(entries_, p.contact, [](const Entry& e) { return e.found.contact; });
    const softbody::PairEnergy* end = find(ended, p.contact, contact_of);
    if (before && end) entry.stored = std::clamp(before->stored + end->joules - before->found.joules, 0.0, p.joules);
  }
  entries_ = std::move(now);
  vertices_ = vertices;
  return brought;
}

double ShieldAccount::stored() const {
  double sum = 0;
  for (const Entry& e : entries_) sum += e.stored;
  return sum;
}

}  // namespace app

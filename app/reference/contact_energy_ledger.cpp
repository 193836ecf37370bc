#include "app/reference/contact_energy_ledger.h"

#include <algorithm>

namespace app::reference {
namespace {

const collide::Contact& contact_of(const softbody::PairEnergy& p) { return p.contact; }
constexpr auto contact_in = [](const auto& entry) -> const collide::Contact& { return entry.found.contact; };

/// Returns the entry of a contact in an ascending list; nullptr if there is none.
template <class List, class Projection>
auto find(const List& list, const collide::Contact& contact, Projection of) -> decltype(&*list.begin()) {
  const auto at = std::ranges::lower_bound(list, contact, {}, of);
  return at != list.end() && of(*at) == contact ? &*at : nullptr;
}

}  // namespace

double ContactEnergyLedger::add_bodies(std::span<const softbody::PairEnergy> found, std::size_t first) {
  double came = 0;
  for (const softbody::PairEnergy& p : found) {
    if (p.contact.b < first) continue;
    entries_.push_back({p, p.joules});
    came += p.joules;
  }
  std::ranges::sort(entries_, {}, contact_in);
  return came;
}

void ContactEnergyLedger::end_frame(std::span<const softbody::PairEnergy> ended,
                                    std::span<const softbody::PairEnergy> found) {
  std::vector<Entry> now;
  for (const softbody::PairEnergy& p : found) {
    Entry& entry = now.emplace_back(Entry{p, 0});
    const Entry* before = find(entries_, p.contact, contact_in);
    if (!before) continue;
    const softbody::PairEnergy* end = find(ended, p.contact, contact_of);
    const double put_in = end ? end->joules - before->found.joules : 0;
    entry.stored = std::clamp(before->stored + put_in, 0.0, p.joules);
  }
  entries_ = std::move(now);
}

double ContactEnergyLedger::stored() const {
  double sum = 0;
  for (const Entry& e : entries_) sum += e.stored;
  return sum;
}

}  // namespace app::reference

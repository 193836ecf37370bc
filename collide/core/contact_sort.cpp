#include "collide/core/contact_sort.h"

#include <algorithm>
#include <utility>

namespace collide {

void ContactSort::sort(std::vector<Contact>& contacts, Range vertices) {
  sort_by_first(contacts, vertices);
  for (auto row = contacts.begin(), end = row; row != contacts.end(); row = end) {
    end = std::find_if(row, contacts.end(), [a = row->a](const Contact& contact) { return contact.a != a; });
    if (!std::is_sorted(row, end)) std::sort(row, end);
  }
}

void ContactSort::sort_by_first(std::vector<Contact>& contacts, Range vertices) {
  constexpr std::size_t few_share = 16;  // fewer contacts are not worth a pass over all vertices
  if (contacts.size() < vertices.size() / few_share) return std::sort(contacts.begin(), contacts.end());
  end_.assign(vertices.size(), 0);
  for (const Contact& contact : contacts) ++end_[contact.a - vertices.begin];
  Index total = 0;
  for (Index& count : end_) total += std::exchange(count, total);
  sorted_.resize(contacts.size());
  for (const Contact& contact : contacts) sorted_[end_[contact.a - vertices.begin]++] = contact;
  contacts.swap(sorted_);
}

}  // namespace collide

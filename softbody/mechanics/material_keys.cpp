#include "softbody/mechanics/material_keys.h"

#include <algorithm>
#include <vector>

#include "softbody/contact/keys.h"
#include "softbody/forces/table.h"
#include "softbody/model/material.h"

namespace softbody {
namespace {

std::vector<const Key*> list_keys() {
  std::vector<const Key*> list;
  const auto add = [&list](const auto& keys) {
    for (const Key* key : keys) list.push_back(key);
  };
  add(Material::keys);
  for_each_force(Forces{}, [&]<class F>(Name<F>) {
    if constexpr (requires { F::keys; }) add(F::keys);
  });
  add(contact::keys);
  std::ranges::stable_sort(list, {}, [](const Key* key) { return key->options.place; });
  return list;
}

}  // namespace

std::span<const Key* const> material_keys() {
  static const std::vector<const Key*> all = list_keys();
  return all;
}

}  // namespace softbody

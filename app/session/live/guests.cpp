#include "app/session/live/guests.h"

#include <algorithm>
#include <utility>

#include "app/base/text.h"

namespace app::session {

using guest::Guest;

Guests::~Guests() {
  for (const auto& guest : guests_) guest->stop();
}

std::vector<std::string> Guests::take_from(std::vector<std::string> dropped) {
  const auto guests = std::stable_partition(dropped.begin(), dropped.end(),
                                            [](const std::string& file) { return !guest::is_guest(file); });
  dropped_.insert(dropped_.end(), guests, dropped.end());
  dropped.erase(guests, dropped.end());
  return dropped;
}

void Guests::answer(bool run) {
  for (const std::string& file : std::exchange(dropped_, {}))
    if (run && std::ranges::find(guests_, std::filesystem::path(file), &Guest::file) == guests_.end())
      add(std::make_shared<Guest>(file));
}

std::optional<std::size_t> Guests::update() {
  if (loading_) {
    if (!loader_.take()) return std::nullopt;
    loading_->rename();
    if (const collide::Method* method = std::exchange(loading_, nullptr)->method())
      return static_cast<std::size_t>(method - collide::method_table().data());
  }
  const auto changed = std::ranges::find_if(guests_, &Guest::changed);
  if (changed == guests_.end()) return std::nullopt;
  dismissed_ = false;
  loading_ = *changed;
  loader_.offer([guest = loading_] { guest->load(); });
  return std::nullopt;
}

std::string Guests::message() const {
  if (asks())
    return "Run " + joined(dropped_, ", ") + " and compare it? It is a program: it may do all that you may do.";
  if (loading_) return "Loading " + loading_->file().filename().string();
  std::string problems;
  for (const auto& guest : guests_)
    if (const auto build = guest->build(); build && !build->problem.empty() && !dismissed_)
      problems += build->errors.empty() ? build->problem + "\n" : build->errors;
  return problems;
}

}  // namespace app::session

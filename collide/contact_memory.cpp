#include "collide/contact_memory.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "collide/reach.h"

namespace collide {

namespace {

constexpr int frames_to_last = 12;     // that candidates should, at the speed of nine tenths of the bodies, both ways
constexpr float least_margin = 0.25f;  // of the tolerance
constexpr float most_margin = 3.0f;    // of the tolerance: beyond it there are too many candidates
constexpr std::uint8_t settled = 8;    // frames with the same move: noted down anew, it is none at all
constexpr double most_stale = 0.3;     // of the bodies, for listing some groups anew rather than all
constexpr std::size_t candidates_a_vertex = 8;  // at most

Run run_of(const Frame& frame, Index body) {
  const Index first = frame.bodies->first[body];
  return {frame.x.data() + first, frame.y.data() + first, frame.z.data() + first, frame.bodies->size(body)};
}

}  // namespace

bool ContactMemory::recall(const Frame& frame, const Settings& settings, GroupSearch& search, Workers& workers,
                           Result& result) {
  if (!same_settings(settings)) {
    forget();
    settings_ = settings;
  }
  if (state_ == State::blank || state_ == State::seen) return false;
  if (!same_bodies(frame)) {
    account_.close();
    start_over();
    return false;
  }
  try {
    if (!account_.spent() && follow(frame, search, workers, result)) return true;
  } catch (...) {  // half done
    forget();
    throw;
  }
  account_.pause();
  start_over();
  return false;
}

/// Forgets all but how it went with these settings.
void ContactMemory::start_over() {
  const Settings settings = settings_;
  const MemoryAccount account = account_;
  forget();
  settings_ = settings;
  account_ = account;
}

bool ContactMemory::follow(const Frame& frame, GroupSearch& search, Workers& workers, Result& result) {
  measure_moves(frame, workers);
  ++age_;
  if (!refresh(frame, search, workers, result)) return false;
  const std::uint64_t before = result.counters.pair_tests;
  test(frame, workers, result);
  account_.earn(frame.x.size(), result.counters.pair_tests - before);
  return true;
}

void ContactMemory::watch(const Frame& frame, const Result& result, Workers& workers) {
  if (account_.take_pause()) return;
  if (state_ == State::blank) {
    state_ = State::seen;
    return;
  }
  age_ = 0;
  account_.open(frame.x.size(), result.contacts.size(), result.counters.pair_tests);
  first_ = frame.bodies->first;
  shape_ = frame.bodies->shape;
  for (auto* coordinate : {&x_, &y_, &z_}) coordinate->resize(frame.x.size());
  move_.assign(shape_.size(), 0);
  note_all(frame, workers);
  state_ = State::noted;  // last: whatever throws before leaves nothing half noted
}

bool ContactMemory::same_settings(const Settings& settings) const {
  return settings.tolerance == settings_.tolerance && settings.self_collision == settings_.self_collision &&
         settings.levels == settings_.levels;
}

bool ContactMemory::same_bodies(const Frame& frame) const {
  return frame.bodies->first == first_ && frame.bodies->shape == shape_;
}

void ContactMemory::note(const Frame& frame, Index body) {
  const Run now = run_of(frame, body);
  const Index first = first_[body];
  std::copy_n(now.x, now.size, x_.begin() + first);
  std::copy_n(now.y, now.size, y_.begin() + first);
  std::copy_n(now.z, now.size, z_.begin() + first);
}

void ContactMemory::note_all(const Frame& frame, Workers& workers) {
  workers.run([&](int thread) {
    const Part part = part_of(shape_.size(), thread, workers.threads());
    for (std::size_t body = part.begin; body < part.end; ++body) note(frame, static_cast<Index>(body));
  });
}

void ContactMemory::measure_moves(const Frame& frame, Workers& workers) {
  still_.resize(shape_.size());
  same_.resize(shape_.size());
  workers.run([&](int thread) {
    const Part part = part_of(shape_.size(), thread, workers.threads());
    for (auto body = static_cast<Index>(part.begin); body < part.end; ++body) {
      const Run now = run_of(frame, body);
      if (now.size == 0) continue;
      const Index first = first_[body];
      const float move = farthest_move(now, {&x_[first], &y_[first], &z_[first], now.size});
      const auto next = [](std::uint8_t count) { return static_cast<std::uint8_t>(std::min(count + 1, 255)); };
      same_[body] = move == move_[body] ? next(same_[body]) : std::uint8_t{0};
      still_[body] = move == 0 ? next(still_[body]) : std::uint8_t{0};
      move_[body] = move;
    }
  });
}

/// Brings the groups up to date; false if the bodies are too fast.
bool ContactMemory::refresh(const Frame& frame, GroupSearch& search, Workers& workers, Result& result) {
  result.non_finite_bodies.clear();
  try {
    if (state_ == State::noted) {
      if (!choose_margin(frame, settings_.tolerance)) return false;
      list_all(frame, search, workers, result);
      return true;
    }
    find_stale();
    if (stale_.empty()) return true;
    if (static_cast<double>(stale_.size()) <= most_stale * static_cast<double>(shape_.size())) {
      list_stale(frame, search, workers, result);
      return true;
    }
    if (age_ < 3 || !choose_margin(frame, settings_.tolerance)) return false;
    list_all(frame, search, workers, result);
    return true;
  } catch (const std::length_error&) {  // too many candidates; there may be few contacts
    account_.spend_all();
    return false;
  }
}

/// From how fast nine tenths of the bodies have been since they were noted down.
bool ContactMemory::choose_margin(const Frame& frame, float tolerance) {
  moves_.clear();
  for (Index body = 0; body < shape_.size(); ++body) {
    if (frame.bodies->size(body) > 0) moves_.push_back(move_[body]);
  }
  if (moves_.empty()) return false;
  const auto ninth = moves_.begin() + static_cast<std::ptrdiff_t>(moves_.size() * 9 / 10);
  std::nth_element(moves_.begin(), ninth, moves_.end());
  const float speed = *ninth / static_cast<float>(age_);
  margin_ = std::clamp(frames_to_last * speed, least_margin * tolerance, most_margin * tolerance);
  const float distance = query().distance;
  return speed * 4 < margin_ && std::isfinite(distance * distance);  // speed may not be finite either
}

void ContactMemory::find_stale() {
  const float limit = margin_ * (level_ ? 0.5f : 0.25f) * (1 - 0x1p-20f);
  stale_.clear();
  for (Index body = 0; body < shape_.size(); ++body) {
    if (first_[body + 1] == first_[body]) continue;
    if (!(move_[body] <= limit) || (move_[body] > 0 && same_[body] >= settled)) stale_.push_back(body);
  }
}

GroupSearch::Query ContactMemory::query() const {
  // A pair that is not found is farther apart than this, whatever rounding and underflow do to its squared distance.
  const double distance = double{contact_reach(settings_.tolerance)} + margin_;
  return {.distance = round_up(std::sqrt(distance * distance + 0x1p-146) * (1 + 0x1p-20)),
          .tolerance = settings_.tolerance,
          .self = settings_.self_collision,
          .levels = settings_.levels,
          .most_pairs = std::min(account_.most_candidates(), most_candidates())};
}

std::size_t ContactMemory::most_candidates() const {
  return std::max<std::size_t>(1u << 20, candidates_a_vertex * x_.size());
}

void ContactMemory::list_all(const Frame& frame, GroupSearch& search, Workers& workers, Result& result) {
  search.bound(frame, workers, result.non_finite_bodies);
  search.find(frame, query(), workers);
  search.count(result);
  result.self_contacts = 0;  // those were of candidates
  lists_.clear(shape_.size());
  for (const Index body : search.live()) lists_.add(body, search.group(body), search.partners(body));
  account_.pay_for_all(lists_.candidates.size());
  note_all(frame, workers);
  std::fill(move_.begin(), move_.end(), 0.0f);
  std::fill(still_.begin(), still_.end(), std::uint8_t{0});
  std::fill(same_.begin(), same_.end(), std::uint8_t{0});
  level_ = true;
  age_ = 0;
  slices_hold_ = false;
  state_ = State::listing;
}

/// The others may have moved by up to margin / 4: those that have moved farther are stale, too, from now on.
void ContactMemory::list_stale(const Frame& frame, GroupSearch& search, Workers& workers, Result& result) {
  if (level_) {
    level_ = false;
    find_stale();
  }
  search.bound(frame, workers, result.non_finite_bodies);
  const GroupSearch::Query what = query();
  search.find_near(what.distance, workers);
  find_wanted(search);
  search.find_groups(frame, what, workers, [&](Index body) { return wanted_[body]; });
  search.count(result);
  result.self_contacts = 0;
  merge(search);
  for (const Index body : stale_) {
    note(frame, body);
    move_[body] = 0;
    still_[body] = same_[body] = 0;
  }
  slices_hold_ = false;
}

/// Groups with a stale body in them, now or when they were listed: those that are near no more have to leave the group,
/// since they may not even be finite.
void ContactMemory::find_wanted(const GroupSearch& search) {
  fresh_.assign(shape_.size(), false);
  wanted_.assign(shape_.size(), false);
  for (const Index body : stale_) fresh_[body] = true;
  const auto is_fresh = [&](Index body) { return fresh_[body]; };
  for (const Index body : search.live()) {
    const std::span<const Index> behind = search.near().behind(body), before = lists_.partners_of(body);
    wanted_[body] = fresh_[body] || std::any_of(behind.begin(), behind.end(), is_fresh) ||
                    std::any_of(before.begin(), before.end(), is_fresh);
  }
}

/// The wanted groups as they were found, the others as they were.
void ContactMemory::merge(const GroupSearch& search) {
  std::size_t listed = 0;
  merged_.clear(shape_.size());
  for (const Index body : search.live()) {
    if (wanted_[body]) {
      merged_.add(body, search.group(body), search.partners(body));
      listed += search.group(body).size();
    } else {
      merged_.add(body, lists_.pairs_of(body), lists_.partners_of(body));
    }
  }
  if (merged_.candidates.size() > most_candidates()) throw std::length_error("too many candidates");
  std::swap(lists_, merged_);
  account_.pay_for_some(x_.size(), listed, lists_.candidates.size());
}

void ContactMemory::Lists::clear(std::size_t bodies) {
  groups.assign(bodies, {});
  candidates.clear();
  partners.clear();
}

void ContactMemory::Lists::add(Index body, std::span<const Contact> pairs, std::span<const Index> others) {
  groups[body] = {candidates.size(), candidates.size() + pairs.size(), partners.size(),
                  partners.size() + others.size()};
  candidates.insert(candidates.end(), pairs.begin(), pairs.end());
  partners.insert(partners.end(), others.begin(), others.end());
}

std::span<const Contact> ContactMemory::Lists::pairs_of(Index body) const {
  return std::span(candidates).subspan(groups[body].begin, groups[body].end - groups[body].begin);
}

std::span<const Index> ContactMemory::Lists::partners_of(Index body) const {
  const Group& group = groups[body];
  return std::span(partners).subspan(group.first_partner, group.last_partner - group.first_partner);
}

void ContactMemory::test(const Frame& frame, Workers& workers, Result& result) {
  threads_.resize(std::max(threads_.size(), static_cast<std::size_t>(workers.threads())));
  slices_.resize(shape_.size());
  for (Thread& own : threads_) {
    own.contacts.swap(own.last_contacts);
    own.contacts.clear();
    own.self_contacts = own.tests = own.remembered = own.kept = 0;
  }
  workers.run([&](int thread) {
    const Part part = part_of(lists_.candidates.size() + shape_.size(), thread, workers.threads());
    for (Index body = 0; body < shape_.size(); ++body) {
      const Group& group = lists_.groups[body];
      const std::size_t place = group.begin + body;
      if (group.begin == group.end) continue;
      if (place >= part.begin && place < part.end) test_group(static_cast<std::size_t>(thread), frame, body);
    }
  });
  std::size_t total = 0;
  for (const Thread& thread : threads_) {
    result.self_contacts += thread.self_contacts;
    result.counters.pair_tests += thread.tests;
    result.skip(Skip::remembered_pairs) += thread.remembered;
    result.skip(Skip::kept_pairs) += thread.kept;
    total += thread.contacts.size();
  }
  result.contacts.resize(total);
  auto to = result.contacts.begin();
  for (const Thread& thread : threads_) to = std::copy(thread.contacts.begin(), thread.contacts.end(), to);
  slices_hold_ = true;
}

void ContactMemory::test_group(std::size_t thread, const Frame& frame, Index body) {
  Thread& own = threads_[thread];
  const std::span<const Contact> candidates = lists_.pairs_of(body);
  const std::span<const Index> partners = lists_.partners_of(body);
  const std::size_t before = own.contacts.size();
  const bool kept = slices_hold_ && still(body) &&
                    std::all_of(partners.begin(), partners.end(), [&](Index other) { return still(other); });
  if (kept) {
    own.kept += partners.size();
    const auto last = threads_[slices_[body].thread].last_contacts.begin();
    own.contacts.insert(own.contacts.end(), last + static_cast<std::ptrdiff_t>(slices_[body].begin),
                        last + static_cast<std::ptrdiff_t>(slices_[body].end));
  } else {
    own.remembered += partners.size();
    own.tests += candidates.size();
    own.contacts.resize(before + candidates.size());
    const float tolerance2 = settings_.tolerance * settings_.tolerance;
    Contact* to = own.contacts.data() + before;
    for (const Contact pair : candidates) {
      *to = pair;  // whether it counts is what a processor cannot foresee
      to += squared_distance(frame.x[pair.a], frame.y[pair.a], frame.z[pair.a], frame.x[pair.b], frame.y[pair.b],
                             frame.z[pair.b]) < tolerance2;
    }
    own.contacts.resize(static_cast<std::size_t>(to - own.contacts.data()));
  }
  const Index end = first_[body + 1];
  for (std::size_t k = before; k < own.contacts.size(); ++k) own.self_contacts += own.contacts[k].b < end;
  slices_[body] = {thread, before, own.contacts.size()};
}

}  // namespace collide

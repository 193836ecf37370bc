// All methods on arbitrary bodies over a few frames, against the plain oracle: one detector of each method sees all
// frames, since it may reuse what it learnt from earlier ones, and in every eighth input a second one does, on two
// threads, which take most of their time to wait for one another.

#include <algorithm>
#include <cstdio>
#include <cstdlib>

#include "sequence.h"

namespace fuzz {
namespace {

constexpr int most_frames = 12;                // contacts of bodies at rest are kept from the third on
constexpr std::size_t most_contacts = 50'000;  // with more an input takes seconds, and others find as much in less

void require(bool holds, const char* what, std::string_view method, int frame) {
  if (holds) return;
  std::fprintf(stderr, "%.*s, frame %d: %s\n", static_cast<int>(method.size()), method.data(), frame, what);
  std::abort();
}

/// What every method must find in a frame.
struct Truth {
  std::vector<collide::Contact> contacts;
  std::size_t inside;
  std::vector<collide::Index> non_finite;

  Truth(const collide::test::State& state, const collide::Settings& settings)
      : contacts(collide::test::oracle(state, settings)), inside(collide::test::inside_bodies(state, contacts).size()) {
    for (collide::Index body = 0; body < state.bodies.count(); ++body)
      if (!collide::test::finite(state, body)) non_finite.push_back(body);
  }
};

void check(const collide::Method& method, const collide::Result& result, const Truth& truth, int frame) {
  const auto must = [&](bool holds, const char* what) { require(holds, what, method.key, frame); };
  must(result.non_finite_bodies == truth.non_finite, "names other bodies as not finite");
  must(std::is_sorted(result.contacts.begin(), result.contacts.end()), "contacts out of order");
  must(std::adjacent_find(result.contacts.begin(), result.contacts.end()) == result.contacts.end(),
       "a contact found twice");
  must(std::includes(truth.contacts.begin(), truth.contacts.end(), result.contacts.begin(), result.contacts.end()),
       "a contact that is none");
  if (!method.exact) return;
  must(result.contacts == truth.contacts, "a contact missed");
  must(result.self_contacts == truth.inside, "another number of self contacts");
}

/// One method's detectors: on one thread, and on two where these are asked for.
class Detectors {
 public:
  Detectors(const collide::Method& method, bool both) : method_(method), one_(method.make()) {
    if (both) two_ = method.make();
  }

  void detect(const collide::test::State& state, const collide::Settings& settings, const Truth& truth, int frame) {
    static collide::Workers alone(1), both(2, 0);
    one_->detect(state.frame(), settings, alone, on_one_);
    check(method_, on_one_, truth, frame);
    if (!two_) return;
    two_->detect(state.frame(), settings, both, on_two_);
    check(method_, on_two_, truth, frame);
    require(on_one_.contacts == on_two_.contacts, "two threads find other contacts", method_.key, frame);
  }
  void forget() {
    one_->forget();
    if (two_) two_->forget();
  }

 private:
  const collide::Method& method_;
  std::unique_ptr<collide::Detector> one_, two_;
  collide::Result on_one_, on_two_;
};

void run(Bytes bytes) {
  const bool both = bytes.below(8) == 0, large = bytes.below(8) == 0;
  collide::Settings settings = read_settings(bytes);
  Bodies bodies = read_bodies(bytes, large ? all_sizes : small_sizes);
  std::vector<Detectors> detectors;
  for (const collide::Method& method : collide::method_table()) detectors.emplace_back(method, both);
  for (int frame = 0; frame < most_frames; ++frame) {
    if (!collide::problem(settings).empty()) return;
    const collide::test::State state = bodies.state(settings.tolerance);
    const Truth truth(state, settings);
    if (truth.contacts.size() > most_contacts) return;
    for (Detectors& one : detectors) one.detect(state, settings, truth, frame);
    if (bytes.empty()) return;
    const int next = bytes.below(16);
    if (next == 0) settings = read_settings(bytes);
    if (next == 1) std::ranges::for_each(detectors, &Detectors::forget);
    change(bodies, bytes);
  }
}

}  // namespace
}  // namespace fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  fuzz::run(fuzz::Bytes({data, size}));
  return 0;
}

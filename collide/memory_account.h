#pragma once
// Whether it pays to remember contacts. Where candidates are many or bodies soon too far from where they were, a fresh
// search is cheaper. What each way costs is counted by what it has to look at (never by a clock, so that a run can be
// repeated); remembering starts on credit, each frame adds what a fresh search would have cost and takes what was done,
// and where nothing is left it pauses, twice as long as the last time, until it has paid again.

#include <algorithm>
#include <cstddef>
#include <cstdint>

namespace collide {

class MemoryAccount {
 public:
  /// A fresh search found so many contacts by so many tests: what it took is what a remembered frame saves.
  void open(std::size_t vertices, std::size_t contacts, std::uint64_t tests) {
    fresh_ = a_vertex * double(vertices) + a_contact * double(contacts) + a_test * double(tests);
    credit_ = most_frames * fresh_;
  }
  /// A frame was told by tests of candidates alone.
  void earn(std::size_t vertices, std::uint64_t candidate_tests) {
    credit_ += fresh_ - a_move * double(vertices) - a_candidate_test * double(candidate_tests);
    if (credit_ <= most_frames * fresh_) return;
    credit_ = most_frames * fresh_;
    longest_pause_ = 0;
  }
  /// So many candidates were listed, by a fresh search;
  void pay_for_all(std::size_t listed) { credit_ -= fresh_ + a_candidate * double(listed); }
  /// or by one for some of the vertices' bodies, and merged with others, which made `candidates`.
  void pay_for_some(std::size_t vertices, std::size_t listed, std::size_t candidates) {
    credit_ -= a_vertex * double(vertices) + a_candidate * double(listed) + a_merge * double(candidates);
  }
  void spend_all() { credit_ = 0; }
  bool spent() const { return credit_ <= 0; }
  /// That there is credit for to list.
  std::size_t most_candidates() const { return static_cast<std::size_t>(credit_ / a_candidate); }

  /// Closes the account, but for how it went.
  void close() { pause_ = 0, fresh_ = credit_ = 0; }
  /// The same, and for some frames it is not to be opened.
  void pause() {
    if (spent()) longest_pause_ = std::clamp(2 * longest_pause_, least_pause, most_pause);
    const int frames = spent() ? longest_pause_ : least_pause;
    close();
    pause_ = frames;
  }
  /// Whether it pauses in this frame, of which there is then one less.
  bool take_pause() { return pause_ > 0 && pause_-- > 0; }

 private:
  // About ns on a processor of 2022: of a fresh search, of a remembered frame, and of listing candidates.
  static constexpr double a_vertex = 3, a_contact = 20, a_test = 0.3;
  static constexpr double a_move = 0.7, a_candidate_test = 1;
  static constexpr double a_candidate = 30, a_merge = 2;
  static constexpr double most_frames = 16;                // of fresh searches: at the start, and the most put by
  static constexpr int least_pause = 8, most_pause = 256;  // frames

  double fresh_ = 0, credit_ = 0;
  int pause_ = 0;          // frames left
  int longest_pause_ = 0;  // since remembering has paid
};

}  // namespace collide

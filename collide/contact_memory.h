#pragma once
// What an exact detector keeps from frame to frame: candidates, the pairs of vertices a little farther apart than the
// tolerance. As long as bodies move little, only these have to be looked at.
//
// Why that stays exact. Let m be the margin, and let D(b) bound how far any vertex of body b is from where it was when
// the body was last noted down. Candidates of a group are all pairs closer than reach + m when the group was listed.
//   All bodies noted down as the groups were listed: a pair not listed was at least reach + m apart, and still is at
//   least reach apart while D <= m / 2 for both its bodies, so it is no contact (see contact_reach).
//   Otherwise a body may have moved by D <= m / 4 between being noted down and the listing, and by D <= m / 4 from
//   where it was noted down until now: each of the two by m / 2 at most since the listing, so again no contact.
// A body that has moved farther is stale: it is noted down anew, and every group that it is near is listed anew. Pairs
// of which neither body has moved at all since the last frame have the contacts that they had.

#include "collide/group_search.h"
#include "collide/memory_account.h"

namespace collide {

class ContactMemory {
 public:
  /// The contacts of the frame, if they follow from what is remembered; else false, and then the result means nothing:
  /// start it afresh. Uses `search` for the groups that have to be listed anew. What it throws leaves nothing
  /// remembered.
  bool recall(const Frame& frame, const Settings& settings, GroupSearch& search, Workers& workers, Result& result);

  /// To be called after a frame that was not recalled, of which this is the result.
  void watch(const Frame& frame, const Result& result, Workers& workers);

  void forget() { *this = {}; }

 private:
  enum class State {
    blank,    // nothing is known
    seen,     // a frame has gone by: the next one that is not recalled is noted down, unless the bodies were too fast
    noted,    // all bodies are noted down, so that the next frame tells how fast they are
    listing,  // there are candidates
  };
  struct Group {
    std::size_t begin = 0, end = 0;                   // of the candidates
    std::size_t first_partner = 0, last_partner = 0;  // of the bodies in them, itself left out
  };
  struct Lists {
    std::vector<Group> groups;  // of each body
    std::vector<Contact> candidates;
    std::vector<Index> partners;

    void clear(std::size_t bodies);
    /// Appends the group of a body.
    void add(Index body, std::span<const Contact> pairs, std::span<const Index> others);
    std::span<const Contact> pairs_of(Index body) const;
    std::span<const Index> partners_of(Index body) const;
  };
  struct Slice {
    std::size_t thread, begin, end;
  };
  struct alignas(64) Thread {
    std::vector<Contact> contacts, last_contacts;  // of this frame and of the last one
    std::uint64_t self_contacts = 0, tests = 0, remembered = 0, kept = 0;
  };

  bool same_settings(const Settings& settings) const;
  bool same_bodies(const Frame& frame) const;
  void start_over();
  void measure_moves(const Frame& frame, Workers& workers);
  void note(const Frame& frame, Index body);
  void note_all(const Frame& frame, Workers& workers);
  bool choose_margin(const Frame& frame, float tolerance);
  void find_stale();
  bool refresh(const Frame& frame, GroupSearch& search, Workers& workers, Result& result);
  GroupSearch::Query query() const;
  void list_all(const Frame& frame, GroupSearch& search, Workers& workers, Result& result);
  void list_stale(const Frame& frame, GroupSearch& search, Workers& workers, Result& result);
  void find_wanted(const GroupSearch& search);
  void merge(const GroupSearch& search);
  std::size_t most_candidates() const;  // so that memory is bounded, however many contacts a fresh search lists
  void test(const Frame& frame, Workers& workers, Result& result);
  void test_group(std::size_t thread, const Frame& frame, Index body);
  bool still(Index body) const { return still_[body] >= 2; }

  bool follow(const Frame& frame, GroupSearch& search, Workers& workers, Result& result);

  State state_ = State::blank;
  MemoryAccount account_;
  Settings settings_;
  std::vector<Index> first_;
  std::vector<std::shared_ptr<const Shape>> shape_;
  std::vector<float> x_, y_, z_;            // where bodies were noted down
  std::vector<float> move_;                 // of each body: D
  std::vector<std::uint8_t> still_, same_;  // frames in a row with no move at all, or with the same D; at most 255
  std::vector<Index> stale_;
  float margin_ = 0;
  bool level_ = false;    // all bodies were noted down as the groups were listed
  int age_ = 0;           // frames since then
  Lists lists_, merged_;  // merged_, fresh_, wanted_, moves_: memory of single functions
  std::vector<bool> fresh_, wanted_;
  std::vector<float> moves_;
  std::vector<Slice> slices_;  // of each body: its contacts in the last frame
  bool slices_hold_ = false;
  std::vector<Thread> threads_;  // as many as there ever were
};

}  // namespace collide

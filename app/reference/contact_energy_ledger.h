#pragma once
// What bodies have put into the shields between them. A pair's potential does not tell: it appears when the pair is
// found, whole where it is found from behind; and every frame finds normals and shares of stiffness anew. Only what it
// changes by within a frame, by the bodies' motion against its force, is the bodies'. Only bodies that begin or join
// close to others have all that their pairs hold there, from behind or not. Knows no world.

#include <span>
#include <vector>

#include "softbody/shield.h"

namespace app {

class ContactEnergyLedger {
 public:
  /// Bodies that begin, or that join in the coming frame: theirs are the vertices from `first` on. found: the pairs at
  /// the positions where they do, before they have moved, ascending by contact; of those with such a vertex the account
  /// has all that they hold. What a joiner's first frame carries it into is found there, and nobody's, as any other
  /// pair. Returns how much came, J.
  double add_bodies(std::span<const softbody::PairEnergy> found, std::size_t first);

  /// After a frame, pairs ascending by contact. ended: those that acted in it, as it left them; found: those found on
  /// the new positions. A pair never holds less than nothing, nor more than its potential: what it gives beyond what it
  /// was given is a gain of the bodies, and what it can no longer give is lost. One that did not act, as that of a body
  /// in its first frame, keeps what it has.
  void end_frame(std::span<const softbody::PairEnergy> ended, std::span<const softbody::PairEnergy> found);

  double stored() const;  // J, of all pairs

 private:
  struct Entry {
    softbody::PairEnergy found;  // the potential that the coming frame starts with
    double stored;               // J
  };
  std::vector<Entry> entries_;  // ascending
};

}  // namespace app

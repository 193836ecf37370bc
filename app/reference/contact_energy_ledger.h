#pragma once
// Books the energy that bodies have put into the penalty contacts between them. The potential of a pair alone does not
// tell: it appears as a whole when the pair is found, even from behind, and each frame finds normals and shares of
// stiffness anew. Only the change within a frame, by the bodies' motion against the force, is the bodies' energy.
// Bodies that start or are added close to others are an exception: they own all that their pairs hold at that moment.
// The ledger knows no world.

#include <span>
#include <vector>

#include "softbody/forces/pair_energy.h"

namespace app::reference {

class ContactEnergyLedger {
 public:
  /// Adds bodies that start, or that are added in the coming frame: they own the vertices from `first` on. found: the
  /// pairs at their first positions, before they have moved, ascending by contact. All that pairs with such a vertex
  /// hold is booked. What the first frame of an added body moves it into belongs to nobody, as with any other pair.
  /// Returns the energy that was booked (J).
  double add_bodies(std::span<const softbody::PairEnergy> found, std::size_t first);

  /// Books a frame. ended: the pairs that acted in the frame, at its end; found: the pairs at the new positions; both
  /// ascending by contact. A pair holds at least 0 and at most its potential. If it gives more than it was given, the
  /// bodies gain energy; what it can no longer give is lost. A pair that did not act, as in a body's first frame, keeps
  /// what it holds.
  void end_frame(std::span<const softbody::PairEnergy> ended, std::span<const softbody::PairEnergy> found);

  /// Returns the energy of all pairs (J).
  double stored() const;

 private:
  struct Entry {
    softbody::PairEnergy found;  // its potential at the start of the coming frame
    double stored;               // J
  };
  std::vector<Entry> entries_;  // ascending
};

}  // namespace app::reference

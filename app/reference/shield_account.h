#pragma once
// What bodies have put into the shields between them. A pair's potential does not tell: it appears when the pair is
// found, whole where it is found from behind; and every frame finds normals and shares of stiffness anew. Only what it
// changes by within a frame, by the bodies' motion against its force, is the bodies'. Knows no world.

#include <span>
#include <vector>

#include "softbody/shield.h"

namespace app {

class ShieldAccount {
 public:
  /// With all that these pairs hold: bodies that begin close to each other have it from the start. vertices: that there
  /// are, of all bodies.
  ShieldAccount(std::span<const softbody::PairEnergy> found, std::size_t vertices);

  /// After a frame, pairs ascending by contact. ended: those that acted in it, as it left them; found: those found on
  /// the new positions. A pair never holds less than nothing, nor more than its potential: what it gives beyond what it
  /// was given is a gain of the bodies, and what it can no longer give is lost. vertices: as many as there are now;
  /// those that have come since have all that their pairs hold. Returns how much, J.
  double frame(std::span<const softbody::PairEnergy> ended, std::span<const softbody::PairEnergy> found,
               std::size_t vertices);

  double stored() const;  // J, of all pairs

 private:
  struct Entry {
    softbody::PairEnergy found;  // the potential that the coming frame starts with
    double stored;               // J
  };
  std::vector<Entry> entries_;  // ascending
  std::size_t vertices_;
};

}  // namespace app

#include "collide/methods/cell_hash.h"

namespace collide::methods {

void CellList::tidy() {
  std::sort(cells_.begin(), cells_.end());
  cells_.erase(std::unique(cells_.begin(), cells_.end()), cells_.end());
  if (cells_.size() > DebugGeometry::debug_cell_limit) cells_.resize(DebugGeometry::debug_cell_limit);
}

}  // namespace collide::methods

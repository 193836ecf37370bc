#pragma once
// The interface of every detector.

#include "collide/core/debug_geometry.h"
#include "collide/core/result.h"
#include "collide/core/settings.h"
#include "collide/core/workers.h"

namespace collide {

/// Finds the contacts of one frame after another. Keeps scratch memory and, where the method reuses them, results of
/// earlier frames. Bodies may come and go between frames. Deterministic: the result does not depend on the workers.
class Detector {
 public:
  virtual ~Detector() = default;
  /// Overwrites `result` with the contacts of the frame. Preconditions: problem(settings) is empty, is_complete(frame).
  /// Throws std::length_error if the method would need more memory than it may take.
  virtual void detect(const Frame& frame, const Settings& settings, Workers& workers, Result& result) = 0;
  /// Drops the results of earlier frames, so that the next frame is found from scratch. Keeps the scratch memory.
  virtual void forget() {}
  /// Returns what the last detect() built; empty for methods that build no boxes and no table.
  virtual DebugGeometry debug() const { return {}; }
};

}  // namespace collide

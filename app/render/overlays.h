#pragma once
// What can be drawn over the bodies. Panel, shortcuts, preferences, scene view, legend and tests loop over one table.

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "app/compare/table_contents.h"
#include "engine/frame_data.h"
#include "softbody/world/bodies_in_motion.h"

namespace app::render {

struct OverlayRequest;

struct Overlays {
  bool body_boxes = false;
  bool boxes = false;
  bool cells = false;
  bool contacts = false;
  bool springs = false;
  bool missed = false;
  bool areas = false;
  bool surface_contacts = false;
  bool true_surfaces = false;

  bool operator==(const Overlays&) const = default;
  bool any() const { return *this != Overlays(); }
};

/// What overlays are drawn from.
struct OverlayInput {
  const softbody::BodiesInMotion& world;
  const OverlayRequest& request;
  glm::vec3 eye;
  float pixels_at_one_metre;  // that 1 m covers at a distance of 1 m
  // Where the vertices of the world are drawn: of the meshes that it shows, and of those that it simulates.
  std::span<const glm::vec3> shown, simulated;
};

/// What legends tell beside colours.
struct LegendFacts {
  const softbody::BodiesInMotion& world;
  const collide::DebugGeometry* debug;          // as in OverlayRequest
  const std::vector<collide::Contact>* missed;  // the same
  std::string_view misses_of;                   // the name of the method that missed them
};

/// A line of a legend: a text, behind a sample of its colour if it has one.
struct LegendLine {
  std::string text;
  std::optional<glm::vec3> colour{};
  bool pale = false;
  glm::vec3 (*scale)(float share) = nullptr;  // colours from this text (0) to `end` (1)
  std::string end{};
};

/// What an overlay belongs to: the bodies as they are drawn, perhaps between two steps; or the present state; or the
/// hash table of the present state.
enum class OverlayBasis { picture, present, table };

struct OverlayRow {
  std::string_view key;      // in preferences and tests
  std::string_view label;    // on the panel
  char shortcut;             // on the keyboard
  std::string_view tooltip;  // what it shows, with its section of the paper
  bool Overlays::*shown;
  void (*add)(const OverlayInput& from, engine::FrameData& frame);
  std::vector<LegendLine> (*legend)(const LegendFacts& facts) = nullptr;
  int layer = 2;  // 0 to 2: higher ones are drawn later. A bucket is drawn between 1 and 2
  OverlayBasis basis = OverlayBasis::picture;
  bool needs_solver = false;  // there is none where the motion is recorded
};

/// In the order of the panel.
extern const std::span<const OverlayRow> overlay_table;

/// True if an overlay is shown that belongs to this basis or to a later one.
bool shows(const Overlays& shown, OverlayBasis basis);

/// Adds the requested overlays.
void add_overlays(const OverlayInput& from, engine::FrameData& frame);

/// Returns the box of a grid cell, with the cells numbered as in §2.2. size: the sides of a cell.
engine::Box cell_box(const compare::Cell& cell, const glm::vec3& size, const glm::vec4& colour);

}  // namespace app::render

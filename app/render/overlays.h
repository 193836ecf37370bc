#pragma once
// What can be drawn over the bodies. Panel, shortcuts, preferences, scene view and tests loop over one table.

#include <array>
#include <string_view>

namespace app::render {

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

struct OverlayRow {
  std::string_view key;      // in preferences and tests
  std::string_view label;    // on the panel
  char shortcut;             // on the keyboard
  std::string_view tooltip;  // what it shows, with its section of the paper
  bool Overlays::*shown;
  bool needs_solver = false;  // there is none where the motion is recorded
};

inline constexpr std::array<OverlayRow, 9> overlay_table{{
    {"body-boxes", "Body boxes", '1', "The bounding box of each body, in the body's colour (§2.1).",
     &Overlays::body_boxes},
    {"boxes", "Subdivided boxes", '2',
     "The boxes that the method hashes (§2.1). The colour is that of the bucket of the box's minimum corner (§2.2).",
     &Overlays::boxes},
    {"cells", "Occupied cells", '3', "The grid cells with at least one entry in the hash table (§2.2).",
     &Overlays::cells},
    {"contacts", "Contacts", '4',
     "Pairs of vertices closer than the tolerance, and vertices that touch a solid (§2.3).", &Overlays::contacts},
    {"springs", "Springs", '5',
     "All springs, coloured by their strain. From far away only the springs along edges are drawn.", &Overlays::springs,
     true},
    {"missed", "Missed contacts", '6',
     "True contacts that the paper's method misses, or the method that you choose in the comparison (V). A ring shows "
     "where, and how many.",
     &Overlays::missed},
    {"areas", "Areas searched", '7', "Where the exact method searches for contacts between two bodies (§2.1, §5).",
     &Overlays::areas},
    {"touches", "Surface contacts", '8',
     "The two closest points and the normal of each surface contact. There are none with vertex-vertex contact, and "
     "none between bodies that sleep.",
     &Overlays::surface_contacts, true},
    {"true-surfaces", "True surfaces", '9',
     "Checks the surfaces exactly: how many vertices are inside other bodies, and which of these overlaps have no "
     "contact. The latter are drawn.",
     &Overlays::true_surfaces},
}};

}  // namespace app::render

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
  bool any() const {
    return body_boxes || boxes || cells || contacts || springs || missed || areas || surface_contacts || true_surfaces;
  }
};

struct OverlayRow {
  std::string_view key;      // in preferences and tests
  std::string_view label;    // on the panel
  char shortcut;             // on the keyboard
  std::string_view tooltip;  // what it shows, with its section of the paper
  bool Overlays::*shown;
};

inline constexpr std::array<OverlayRow, 9> overlay_table{{
    {"body-boxes", "Body boxes", '1', "The axis-aligned bounding box of each body, in the body's colour (§2.1).",
     &Overlays::body_boxes},
    {"boxes", "Subdivided boxes", '2',
     "The boxes that the method hashes, each in the colour of the bucket of its minimum corner (§2.1, §2.2). Boxes of "
     "one colour meet in one bucket.",
     &Overlays::boxes},
    {"cells", "Occupied cells", '3', "The grid cells that hold at least one entry of the hash table (§2.2).",
     &Overlays::cells},
    {"contacts", "Contacts", '4',
     "Pairs of vertices closer than the tolerance, and vertices that touch a solid (§2.3).", &Overlays::contacts},
    {"springs", "Springs", '5',
     "The springs of every body, coloured by their strain: shorter or longer than at rest. From far away only those "
     "along edges: come closer to see all.",
     &Overlays::springs},
    {"missed", "Missed contacts", '6',
     "Contacts that brute force finds and the driving method does not. A ring shows where, and how many. Only the "
     "literal method can miss any.",
     &Overlays::missed},
    {"areas", "Areas searched", '7',
     "Where two bodies can touch, and how these areas are cut: the exact method looks nowhere else (§2.1, §5).",
     &Overlays::areas},
    {"touches", "Surface contacts", '8',
     "Where surfaces pressed on each other at the end of the last step with motion: the two closest points and the "
     "normal. None with vertex-vertex contact, and none between bodies that sleep.",
     &Overlays::surface_contacts},
    {"true-surfaces", "True surfaces", '9',
     "The surfaces judged exactly, beside the simulation: what is inside what, how deep, what passed through, and what "
     "of it the method's contacts do not show; that is drawn.",
     &Overlays::true_surfaces},
}};

}  // namespace app::render

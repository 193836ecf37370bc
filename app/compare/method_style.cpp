#include "app/compare/method_style.h"

#include <algorithm>
#include <array>

namespace app::compare {
namespace {

constexpr glm::vec3 rgb(int red, int green, int blue) {
  return glm::vec3(static_cast<float>(red) / 255, static_cast<float>(green) / 255, static_cast<float>(blue) / 255);
}

struct Row {
  std::string_view key;
  MethodStyle style;
};

/// The first six colours are Okabe and Ito's. The others are as far from all as colours can be for eyes of any kind.
constexpr std::array styles{
    Row{"brute-force", {rgb(153, 153, 153), Marker::plus, true}},
    Row{"grid-hash", {rgb(213, 94, 0), Marker::square, true}},
    Row{"bounding-box", {rgb(230, 159, 0), Marker::triangle, false}},
    Row{"bounding-box-grid-hash", {rgb(204, 121, 167), Marker::diamond, false}},
    Row{"multi-level-sb", {rgb(86, 180, 233), Marker::circle, true}},
    Row{"multi-level-sb-complete", {rgb(0, 114, 178), Marker::filled_pentagon, false}},
    Row{"multi-level-sb-exact", {rgb(0, 158, 115), Marker::disc, true}},
    Row{"sorted-grid", {rgb(0, 68, 238), Marker::filled_square, true}},
    Row{"sweep-and-prune", {rgb(170, 238, 136), Marker::cross, false}},
    Row{"aabb-tree", {rgb(153, 68, 51), Marker::filled_triangle, true}},
    Row{"kd-tree", {rgb(187, 102, 255), Marker::filled_diamond, false}},
    Row{"octree", {rgb(0, 238, 238), Marker::filled_inverted_triangle, false}},
};

// For methods without a row, in turn. 3 and 5 have no common divisor, so the first 15 methods all differ.
constexpr std::array further_markers{Marker::star, Marker::inverted_triangle, Marker::pentagon};
constexpr std::array further_colours{rgb(0, 0, 0), rgb(170, 0, 85), rgb(85, 102, 0), rgb(255, 85, 170),
                                     rgb(68, 51, 136)};

}  // namespace

MethodStyle style(const collide::Method& method) {
  const auto row_of = [](const collide::Method& each) { return std::ranges::find(styles, each.key, &Row::key); };
  if (const auto row = row_of(method); row != styles.end()) return row->style;
  const auto number =
      static_cast<std::size_t>(std::count_if(collide::method_table().data(), &method, [&](const collide::Method& each) {
        return row_of(each) == styles.end();
      }));
  return {further_colours[number % further_colours.size()], further_markers[number % further_markers.size()], true};
}

}  // namespace app::compare

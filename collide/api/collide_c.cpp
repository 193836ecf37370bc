#include "collide/api/sbcollide/collide_c.h"

#include <cmath>
#include <limits>

#include "collide/api/guarded.h"
#include "collide/api/sbcollide/collide.h"

static_assert(sizeof(sbcollide_contact) == sizeof(sbcollide::Contact));
static_assert(offsetof(sbcollide_contact, b) == offsetof(sbcollide::Contact, b));

using sbcollide::guarded;
using sbcollide::require_pointer;

struct sbcollide_finder {
  sbcollide::FinderSettings settings;
  sbcollide::ContactFinder finder;
  sbcollide::Detection found;
  std::string error;

  /// Throws Error.
  void take(const sbcollide::FinderSettings& changed) {
    finder.configure(changed);
    settings = changed;
    found = {};
  }
};

namespace {

/// Returns a number as an integer. Throws Error.
template <class Integer>
Integer whole(double value, const char* name) {
  if (value != std::floor(value) || !(value >= 0 && value <= std::numeric_limits<int>::max()))
    throw sbcollide::Error(std::string(name) + ": must be a whole number");
  return static_cast<Integer>(value);
}

}  // namespace

const char* sbcollide_version(void) { return SBCOLLIDE_VERSION; }

sbcollide_finder* sbcollide_finder_new(void) { return sbcollide::made<sbcollide_finder>(); }

void sbcollide_finder_free(sbcollide_finder* finder) { delete finder; }

const char* sbcollide_finder_error(const sbcollide_finder* finder) { return finder->error.c_str(); }

sbcollide_status sbcollide_finder_set(sbcollide_finder* finder, sbcollide_finder_setting setting, double value) {
  return guarded(finder, [&] {
    sbcollide::FinderSettings changed = finder->settings;
    switch (setting) {
      case SBCOLLIDE_TOLERANCE:
        changed.tolerance = static_cast<float>(value);
        break;
      case SBCOLLIDE_SELF_COLLISION:
        changed.self_collision = value != 0;
        break;
      case SBCOLLIDE_THREADS:
        changed.threads = whole<int>(value, "threads");
        break;
      case SBCOLLIDE_LEVELS:
        changed.levels = whole<int>(value, "levels");
        break;
      case SBCOLLIDE_BUCKETS:
        changed.buckets = whole<std::uint32_t>(value, "buckets");
        break;
      case SBCOLLIDE_CELL_SIZE:
        changed.cell_size.fill(static_cast<float>(value));
        break;
      default:
        throw sbcollide::Error("setting " + std::to_string(int(setting)) + ": there is none");
    }
    finder->take(changed);
  });
}

sbcollide_status sbcollide_finder_set_method(sbcollide_finder* finder, const char* key) {
  return guarded(finder, [&] {
    require_pointer(key, 1, "key");
    sbcollide::FinderSettings changed = finder->settings;
    changed.method = key;
    finder->take(changed);
  });
}

sbcollide_status sbcollide_finder_add_body(sbcollide_finder* finder, uint32_t vertices, const uint32_t* triangles,
                                           size_t triangle_count, const uint32_t* edges, size_t edge_count,
                                           const float* rest) {
  return guarded(finder, [&] {
    const auto faces = sbcollide::groups_at<3>(triangles, triangle_count, "triangles");
    const auto sides = sbcollide::groups_at<2>(edges, edge_count, "edges");
    const sbcollide::BodyMesh mesh{
        .vertices = vertices,
        .triangles = faces,
        .edges = sides,
        .rest = {rest, rest ? 3 * std::size_t{vertices} : std::size_t{0}},
    };
    finder->found = {};
    finder->finder.add_body(mesh);
  });
}

sbcollide_status sbcollide_finder_clear_bodies(sbcollide_finder* finder) {
  return guarded(finder, [&] {
    finder->found = {};
    finder->finder.clear_bodies();
  });
}

uint32_t sbcollide_finder_vertices(const sbcollide_finder* finder) { return finder->finder.vertices(); }

sbcollide_status sbcollide_finder_find(sbcollide_finder* finder, const float* x, const float* y, const float* z) {
  return guarded(finder, [&] {
    finder->found = {};
    const std::size_t count = finder->finder.vertices();
    for (const float* coordinates : {x, y, z}) require_pointer(coordinates, count, "coordinates");
    finder->found = finder->finder.find({x, count}, {y, count}, {z, count});
  });
}

sbcollide_status sbcollide_finder_find_interleaved(sbcollide_finder* finder, const float* xyz) {
  return guarded(finder, [&] {
    finder->found = {};
    const std::size_t count = 3 * std::size_t{finder->finder.vertices()};
    require_pointer(xyz, count, "xyz");
    finder->found = finder->finder.find({xyz, count});
  });
}

size_t sbcollide_finder_contact_count(const sbcollide_finder* finder) { return finder->found.contacts.size(); }

const sbcollide_contact* sbcollide_finder_contacts(const sbcollide_finder* finder) {
  return reinterpret_cast<const sbcollide_contact*>(finder->found.contacts.data());
}

size_t sbcollide_finder_non_finite_count(const sbcollide_finder* finder) {
  return finder->found.non_finite_bodies.size();
}

const uint32_t* sbcollide_finder_non_finite_bodies(const sbcollide_finder* finder) {
  return finder->found.non_finite_bodies.data();
}

#pragma once
// Bodies that the program wrote, for the public interface.

#include <filesystem>
#include <string>
#include <vector>

#include <sbcollide/collide.h>

#include "tests/temporary_folder.h"

namespace api::test {

/// A frame of a scene, as the program simulated it, and the bodies at rest.
struct RecordedBodies {
  /// Fails the test if the program fails.
  RecordedBodies(const std::string& scene, int frame);

  /// Adds the bodies to a finder, or to whatever has the same function.
  void add_to(auto& finder) const {
    for (std::size_t b = 0; b + 1 < first.size(); ++b)
      finder.add_body({.vertices = first[b + 1] - first[b],
                       .triangles = triangles[b],
                       .edges = edges[b],
                       .rest = std::span(rest).subspan(3 * first[b], 3 * (first[b + 1] - first[b]))});
  }
  /// Returns the contacts that `sbcollide detect --method M` finds.
  std::vector<sbcollide::Contact> program_contacts(const std::string& method, float tolerance) const;

  tests::TemporaryFolder folder;
  std::filesystem::path frame_file, rest_file;
  std::vector<float> x, y, z, rest;
  std::vector<sbcollide::Index> first;
  std::vector<std::vector<std::array<sbcollide::Index, 3>>> triangles;  // of each body
  std::vector<std::vector<std::array<sbcollide::Index, 2>>> edges;      // of its faces of four corners
};

}  // namespace api::test

#include "tests/api/recorded_bodies.h"

#include <gtest/gtest.h>

#include <cstdio>
#include <sstream>

#include "softbody/mesh/file_mesh.h"
#include "tests/cli/process.h"

namespace api::test {

RecordedBodies::RecordedBodies(const std::string& scene, int frame) {
  const std::string number = std::to_string(frame), name = std::string(4 - number.size(), '0') + number + ".obj";
  const auto made = cli::test::run(
      {"simulate", "--scene", scene, "--frames", number, "--obj-every", number, "--out", folder.path().string()});
  EXPECT_EQ(made.status, 0) << made.err;
  frame_file = folder.path() / ("frame_" + name);
  rest_file = folder.path() / ("rest_" + name);
  const softbody::FileMesh moved = softbody::read_file_mesh(frame_file), still = softbody::read_file_mesh(rest_file);
  x.assign(moved.x.begin(), moved.x.end());
  y.assign(moved.y.begin(), moved.y.end());
  z.assign(moved.z.begin(), moved.z.end());
  for (std::size_t v = 0; v < x.size(); ++v)
    for (const auto* axis : {&still.x, &still.y, &still.z}) rest.push_back(static_cast<float>((*axis)[v]));
  for (const auto& object : moved.objects) first.push_back(object.first_vertex);
  first.push_back(static_cast<sbcollide::Index>(x.size()));
  triangles.resize(first.size() - 1), edges.resize(first.size() - 1);
  moved.for_each_face([&](std::span<const sbcollide::Index> corners, std::uint64_t) {
    const auto body =
        static_cast<std::size_t>(std::upper_bound(first.begin(), first.end(), corners[0]) - first.begin() - 1);
    const sbcollide::Index origin = first[body];
    if (corners.size() == 3) {
      triangles[body].push_back({corners[0] - origin, corners[1] - origin, corners[2] - origin});
      return;
    }
    for (std::size_t i = 0; i < corners.size(); ++i)
      edges[body].push_back({corners[i] - origin, corners[(i + 1) % corners.size()] - origin});
  });
}

std::vector<sbcollide::Contact> RecordedBodies::program_contacts(const std::string& method, float tolerance) const {
  const std::filesystem::path csv = folder.path() / "contacts.csv";
  std::ostringstream text;
  text << tolerance;
  const auto found = cli::test::run({"detect", frame_file.string(), "--rest", rest_file.string(), "--tolerance",
                                     text.str(), "--method", method, "--contacts", csv.string()});
  EXPECT_EQ(found.status, 0) << found.err;
  std::vector<sbcollide::Contact> contacts;
  std::istringstream lines(cli::test::read_file(csv));
  for (std::string line; std::getline(lines, line);) {
    sbcollide::Contact c{};
    if (std::sscanf(line.c_str(), "%*u,%u,%u", &c.a, &c.b) == 2) contacts.push_back(c);
  }
  return contacts;
}

}  // namespace api::test

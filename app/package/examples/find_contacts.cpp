// Prints the contacts in a mesh: find_contacts FILE.obj TOLERANCE. Each object (a line `o`) is a body; faces have three
// corners.
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <sstream>

#include <sbcollide/collide.h>

int main(int count, char** arguments) try {
  if (count != 3) throw sbcollide::Error("usage: find_contacts FILE.obj TOLERANCE");
  std::vector<float> xyz;  // of all vertices
  std::vector<std::array<sbcollide::Index, 3>> triangles;
  sbcollide::Index first = 0;  // vertex of the present body
  sbcollide::ContactFinder finder({.tolerance = std::strtof(arguments[2], nullptr)});
  const auto end_body = [&] {
    const auto vertices = static_cast<sbcollide::Index>(xyz.size() / 3);
    if (vertices > first) finder.add_body({.vertices = vertices - first, .triangles = triangles});
    first = vertices;
    triangles.clear();
  };
  std::ifstream file(arguments[1]);
  for (std::string line, word; std::getline(file, line);) {
    std::istringstream words(line);
    words >> word;
    if (word == "o") end_body();
    if (word == "v")
      for (float value; words >> value;) xyz.push_back(value);
    if (word == "f") {
      auto& corners = triangles.emplace_back();
      for (auto& corner : corners) words >> word, corner = std::stoul(word) - 1 - first;
    }
  }
  end_body();
  for (const auto& [a, b] : finder.find(xyz).contacts)
    std::cout << a << " of body " << finder.body_of(a) << ", " << b << " of body " << finder.body_of(b) << '\n';
} catch (const std::exception& error) {
  std::cerr << error.what() << '\n';
  return 2;
}

// Drops two soft balls, one above the other, and prints how high they are until they come to rest.
#include <iostream>

#include <sbcollide/softbody.h>

int main() try {
  sbcollide::Scene scene;
  scene.add_ground();
  scene.add_material("rubber", {{"structural.stiffness", 300},
                                {"gas_pressure", 113000},
                                {"ambient_pressure", 101325},
                                {"internal_damping", 10}});
  const int ball = scene.add_sphere_mesh(0.5);
  scene.add_body({.mesh = ball, .material = "rubber", .position = {0, 1, 0}});
  scene.add_body({.mesh = ball, .material = "rubber", .position = {0.1, 2.5, 0}, .velocity = {0, -1, 0}});

  sbcollide::World world(scene, {.threads = 2});
  while (world.frame() < 600 && !world.at_rest()) {
    world.step();
    if (world.frame() % 30 != 0) continue;
    std::cout << world.time() << " s:";
    for (sbcollide::Index body = 0; body < world.bodies(); ++body)
      std::cout << ' ' << world.positions().y[world.first_vertex(body)] << " m";
    std::cout << ", " << world.contacts().size() << " contacts, " << world.energies().kinetic << " J\n";
  }
} catch (const std::exception& error) {
  std::cerr << error.what() << '\n';
  return 2;
}

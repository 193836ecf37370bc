#pragma once
// The loop of a program with a window.

#include <functional>

namespace engine {

/// Calls turn() again and again until it returns false, at most 125 times a second: without a monitor to wait for,
/// pictures would follow each other at once and load the machine for nothing. In a browser it returns at once, and the
/// browser calls turn() before each of its pictures.
void run_loop(std::function<bool()> turn);

}  // namespace engine

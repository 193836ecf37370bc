#pragma once

namespace softbody {

class Dynamics;

/// Semi-implicit (symplectic) Euler: v += h a(x, v), then x += h v. First order; stable below stable_step().
void semi_implicit_euler(Dynamics& dynamics, int thread, float h);

}  // namespace softbody

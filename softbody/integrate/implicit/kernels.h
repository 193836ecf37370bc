#pragma once
// The inner loops of implicit steps, in double, for eight bodies at a time. Vectorised with Highway, which chooses the
// processor's instruction set at run time; the result is the same on every one.

#include <cstdint>
#include <vector>

#include "softbody/state/lanes.h"

namespace softbody {

/// Of a matrix A with P A P^T = L L^T: L by runs of columns whose entries below the run lie in the same rows, each run
/// a dense block, so that nothing is looked up for each entry.
struct CholeskyFactor {
  struct Supernode {
    std::uint32_t first, columns;  // the unknowns first, first + 1, ...
    std::uint32_t below, rows;     // its rows below it: so many, from row[below] on
    std::size_t value;             // its entries: (columns + rows) rows of `columns` each, from value[value] on
  };
  std::vector<std::uint32_t> place;  // of unknown i in the factor's order
  std::vector<Supernode> supernodes;
  std::vector<std::uint32_t> row;
  std::vector<double> value;  // of the diagonal the inverse
};

struct ImplicitKernels {
  void (*substitute)(const CholeskyFactor&, double* x, double* scratch);
  void (*turn)(std::size_t particles, const double (*rotation)[implicit_lanes], bool back, Field<double> v);
  void (*inner_product)(std::size_t count, const double* a, const double* b, double* result);
  void (*add_scaled)(std::size_t count, const double* times, const double* a, double* y);
};

const ImplicitKernels& implicit_kernels();

}  // namespace softbody

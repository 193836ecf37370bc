#include "softbody/integrate/batch_kernels.h"

namespace softbody {
Extent BatchKernels::extent(const Batch& b, const VectorArray& boxed, const VectorArray& measured) const {
  Extent e{};
  (*this)(b).extent(b.particles(), field(boxed, b.base), field(measured, b.base), e);
  return e;
}

}  // namespace softbody

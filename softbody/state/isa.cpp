#include "softbody/state/isa.h"

namespace softbody {

Isa best_isa() {
#if SB_X86
  return __builtin_cpu_supports("avx2") ? Isa::avx2 : Isa::baseline;
#else
  return Isa::baseline;
#endif
}

}  // namespace softbody

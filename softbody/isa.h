#pragma once

namespace softbody {

/// Instruction sets that the inner loops are compiled for. All give the same bits.
enum class Isa { baseline, avx2 };

/// Returns the widest one that this processor and this build have.
Isa best_isa();

}  // namespace softbody

#pragma once

#if defined(__x86_64__) || defined(__i386__)
#define SB_X86 1
#else
#define SB_X86 0
#endif

namespace softbody {

/// Bodies of one model that are solved side by side, one in each SIMD lane.
inline constexpr int lanes = 8;

/// Instruction sets that the inner loops are compiled for. All give the same bits.
enum class Isa { baseline, avx2 };

/// Returns the widest one that this processor and this build have.
Isa best_isa();

}  // namespace softbody

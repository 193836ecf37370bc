#pragma once

#if defined(__x86_64__) || defined(__i386__)
#define SB_X86 1
#else
#define SB_X86 0
#endif

namespace softbody {

/// Number of bodies of one model that are solved side by side, one in each SIMD lane.
inline constexpr int lanes = 8;

/// Instruction sets that the inner loops are compiled for. All give the same bits.
enum class Isa { baseline, avx2 };

/// Returns the widest instruction set that both this processor and this build support.
Isa best_isa();

}  // namespace softbody

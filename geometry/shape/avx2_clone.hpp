#pragma once

/// Placed before a function, this compiles the function twice, once for processors with AVX2, and calls the version
/// that fits. Both do the same operations in the same order, and no operation is contracted, so results are the same to
/// the bit. Sanitizers cannot start programs that choose functions so early, and Windows has no such choice.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(_WIN32) && \
    !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define POLYNYA_AVX2_CLONE __attribute__((target_clones("avx2", "default")))
#else
#define POLYNYA_AVX2_CLONE
#endif

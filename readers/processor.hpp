// SPDX-License-Identifier: BSD-3-Clause
// Hot loops compiled twice, for any x86-64 processor and for those with AVX2; the loader picks. The
// same bits come out, as -ffp-contract=off keeps products and sums apart. Worth 8 % of the whole
// analysis of binary dumps (docs/performance.md).
//
// Such a function must catch what is thrown in it, bad_alloc too: GCC 12 takes it for one that
// throws nothing, and calls it where no exception can be caught.
#pragma once

#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && \
    !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define BEDSCOPE_FOR_EACH_PROCESSOR __attribute__((target_clones("arch=x86-64-v3", "default")))
#else
#define BEDSCOPE_FOR_EACH_PROCESSOR
#endif

// Loops without branches, written for the compiler to vectorise, in one version for any x86-64 and one for those with AVX2: the program
// takes the one for the processor that it meets. ARIFT_VECTOR_VERSIONS void scale(float *values, size_t count) {…}
#pragma once

// The choice is made while the program is loaded, before a sanitizer can run: those, and other machines, get the plain version.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
#define ARIFT_VECTOR_VERSIONS __attribute__((target_clones("arch=x86-64-v3", "default")))
#else
#define ARIFT_VECTOR_VERSIONS
#endif

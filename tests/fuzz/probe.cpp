/* SPDX-License-Identifier: GPL-2.0-or-later */

/* Compiles where the fuzzers do. */

#include <fuzzer/FuzzedDataProvider.h>

extern "C" int LLVMFuzzerTestOneInput(const uint8_t *, size_t)
{
  return 0;
}

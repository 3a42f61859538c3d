/* SPDX-License-Identifier: Apache-2.0 */

/* Cycles' GPU kernels without all but one: that which evaluates and samples the closures of a
 * surface. The others become functions that nobody calls, so the compiler drops them; all of them
 * take minutes. */

#ifdef __CUDA_ARCH__
#  include "kernel/device/cuda/compat.h"
#  include "kernel/device/cuda/config.h"
#  include "kernel/device/cuda/globals.h"

constexpr int threads = GPU_KERNEL_BLOCK_NUM_THREADS;
constexpr int blocks = GPU_MULTIPRESSOR_MAX_REGISTERS / (threads * GPU_KERNEL_MAX_REGISTERS);

#  undef ccl_gpu_kernel
#  undef ccl_gpu_kernel_threads
#  define ccl_gpu_kernel(...) static __device__ __forceinline__ void
#  define ccl_gpu_kernel_threads(...) static __device__ __forceinline__ void

#  include "kernel/device/gpu/image.h"
#  include "kernel/device/gpu/kernel.h"

extern "C" __global__ void __launch_bounds__(threads, blocks)
    shade_surface(const int *path_index_array, float *render_buffer, const int work_size)
{
  kernel_gpu_integrator_shade_surface(path_index_array, render_buffer, work_size);
}
#endif

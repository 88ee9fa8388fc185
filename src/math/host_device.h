// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

/** \brief Marks maths that the host and a device compile from the same source. */
#if defined(__CUDACC__)
#define PCL_FLASHREG_HD __host__ __device__
#else
#define PCL_FLASHREG_HD
#endif

// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

/** \brief Marks what the compiled core offers; everything else in it is hidden. */
#if defined(__GNUC__)
#define PCL_FLASHREG_EXPORT __attribute__((visibility("default")))
#else
#define PCL_FLASHREG_EXPORT
#endif

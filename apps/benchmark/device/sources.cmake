# What is measured on a device: kernels, and the host's side. The tests build it, too.
set(PCL_FLASHREG_DEVICE_BENCHMARK_KERNELS ${CMAKE_CURRENT_LIST_DIR}/ceilings.cu)
set(PCL_FLASHREG_DEVICE_BENCHMARK_HOST
  ceilings.cpp
  device_figures.cpp
  energy_meter.cpp)
list(TRANSFORM PCL_FLASHREG_DEVICE_BENCHMARK_HOST PREPEND ${CMAKE_CURRENT_LIST_DIR}/)

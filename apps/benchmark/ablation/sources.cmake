# The ablation's sources: kernels, and the host's side of them. The tests build them, too.
set(PCL_FLASHREG_ABLATION_KERNELS
  dense_cliques.cu
  dense_graph.cu
  dense_pivots.cu
  dense_refinement.cu
  dense_scores.cu
  dense_verification.cu)
set(PCL_FLASHREG_ABLATION_HOST
  ablation.cpp
  ablation_row.cpp
  ablation_stages.cpp
  dense_product.cpp)
list(TRANSFORM PCL_FLASHREG_ABLATION_KERNELS PREPEND ${CMAKE_CURRENT_LIST_DIR}/)
list(TRANSFORM PCL_FLASHREG_ABLATION_HOST PREPEND ${CMAKE_CURRENT_LIST_DIR}/)

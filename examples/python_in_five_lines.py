# python_in_five_lines.py source.pcd target.pcd
import sys
import pcl_flashreg
result = pcl_flashreg.align(sys.argv[1], sys.argv[2])
print(result)
print(result.T_target_source if result.converged else "nothing to trust")

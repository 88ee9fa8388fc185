# Copyright (c) the pcl_flashreg authors
# Completion for bash: options as --help lists them, and files.
_pcl_flashreg()
{
  local current=${COMP_WORDS[COMP_CWORD]}
  COMPREPLY=()
  if [[ $current == -* ]]; then
    local options
    options=$("$1" --help 2>/dev/null | grep -oE '^ +(-[a-z],)?--[a-z-]+' | grep -oE -- '--[a-z-]+')
    mapfile -t COMPREPLY < <(compgen -W "$options" -- "$current")
  fi
}
complete -o default -F _pcl_flashreg \
  pcl_flashreg_align pcl_flashreg_evaluate pcl_flashreg_localize pcl_flashreg_map

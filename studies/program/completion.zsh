#compdef rollres
# Completion of rollres for zsh, written by `rollres completion zsh`.
_rollres() {
  local -a lines=("${(@f)$(rollres complete "${(@Q)words[2,CURRENT]}" 2>/dev/null)}")
  local -a found=("${(@)${(@)lines[2,-1]//:/\\:}/$'\t'/:}")
  case $lines[1] in
    open) _describe rollres found -S '' ;;
    words) _describe rollres found ;;
    *)
      [[ $PREFIX != --*=* ]] || compset -P '*='
      if [[ $lines[1] == folders ]]; then _files -/; else _files; fi ;;
  esac
}
_rollres "$@"

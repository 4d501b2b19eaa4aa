# Completion of rollres for bash, written by `rollres completion bash`.
_rollres() {
  local i word kind= words=()
  for ((i = 1; i <= COMP_CWORD; i++)); do  # bash takes KEY=VALUE and --option=value apart at the sign
    if [[ ${#words[@]} -gt 0 && (${COMP_WORDS[i]} == = || ${COMP_WORDS[i - 1]} == =) ]]; then
      words[-1]+=${COMP_WORDS[i]}
    else
      words+=("${COMP_WORDS[i]}")
    fi
  done
  local before=${words[-1]%"${words[-1]##*=}"}
  COMPREPLY=()
  while IFS=$'\t' read -r word _; do
    [[ -n $kind ]] || { kind=$word; continue; }
    printf -v word %q "${word#"$before"}"
    word=${word//\\,/,} COMPREPLY+=("${word/#\\~/\~}")
  done < <("${COMP_WORDS[0]}" complete "${words[@]}" 2>/dev/null)
  [[ $kind != open ]] || compopt -o nospace
  [[ $kind != folders ]] || compopt -o dirnames
  [[ $kind == files ]] || compopt +o default +o bashdefault
}
complete -o bashdefault -o default -F _rollres rollres

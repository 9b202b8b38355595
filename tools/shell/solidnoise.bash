# Completion in bash: the programs say what may come next. Where that is nothing, files do.
_solidnoise() {
  local word words=()
  for word in "${COMP_WORDS[@]:1:COMP_CWORD-1}"; do
    [[ $word == = ]] || words+=("$word")  # of --flag=value, which are three words here
  done
  mapfile -t COMPREPLY < <("$1" "${words[@]}" --complete "${2#=}" 2>/dev/null | cut -d' ' -f1)
}
complete -o bashdefault -o default -F _solidnoise vdbnoise meshnoise noisefit

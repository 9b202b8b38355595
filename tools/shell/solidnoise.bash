# Completion in bash: the programs say what may come next. Where that is nothing, files do.
_solidnoise() {
  mapfile -t COMPREPLY < <("$1" "${COMP_WORDS[@]:1:COMP_CWORD-1}" --complete "$2" 2>/dev/null | cut -d' ' -f1)
}
complete -o bashdefault -o default -F _solidnoise vdbnoise meshnoise noisefit

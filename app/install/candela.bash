# SPDX-License-Identifier: MIT
# Completion for bash: commands, the options that --help lists, their choices, and files.
_candela() {
    local current=${COMP_WORDS[COMP_CWORD]} previous=${COMP_WORDS[COMP_CWORD - 1]} command="" word help choices
    for word in "${COMP_WORDS[@]:1:COMP_CWORD-1}"; do
        case $word in view | render | screenshot | info | compare | validate) command=$word && break ;; esac
    done
    # shellcheck disable=SC2086
    help=$("${COMP_WORDS[0]}" $command --help 2>/dev/null)
    if [[ $previous == --* ]]; then
        choices=$(sed -nE "s/^ +(-[a-z],)?$previous +([a-z-]+(\|[a-z-]+)+)( .*)?$/\2/p" <<<"$help")
        [[ -n $choices ]] && mapfile -t COMPREPLY < <(compgen -W "${choices//|/ }" -- "$current") && return
    fi
    if [[ $current == -* ]]; then
        mapfile -t COMPREPLY < <(compgen -W "$(grep -oE -- '^ +(-[a-z],)?--[a-z0-9-]+' <<<"$help" | grep -oE -- '--.*')" -- "$current")
        return
    fi
    compopt -o filenames 2>/dev/null
    mapfile -t COMPREPLY < <(compgen -f -- "$current")
    [[ -z $command && $COMP_CWORD -eq 1 ]] &&
        mapfile -t -O "${#COMPREPLY[@]}" COMPREPLY < <(compgen -W "view render screenshot info compare validate" -- "$current")
}
complete -F _candela candela
